#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/multipath/apply.h"
#include "pipeline/multipath/floor_evidence.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

struct OneBounceParams {
  double signal = 1300;
  double least_evidence = 0.4, most_evidence = 3, factor = 1;
  int scan_frames = 30;
};

template <class V>
void fields(V& v, OneBounceParams& p) {
  v("signal", p.signal, 1.0, 1e6, "counts", "infrared amplitude of a white surface that faces the sensor at 1 m");
  v("least_evidence", p.least_evidence, 0.0, 10.0, "",
    "of the predicted bend of floors (1: all of it), below which nothing is corrected");
  v("most_evidence", p.most_evidence, 1.0, 100.0, "",
    "of the predicted bend, above which something else bends the floors and nothing is corrected");
  v("factor", p.factor, 0.0, 3.0, "", "on predicted errors");
  v("scan_frames", p.scan_frames, 3, 1000, "", "frames of a scan whose floor is looked at");
}

constexpr float kNear = 3;            // metres: the body rather than walls
constexpr double kUneven = 0.2;       // of the predicted bend: floors have other reasons to be uneven
constexpr double kSure = 3;           // sigmas that the evidence must be off nothing
constexpr double kUsualAlbedo = 0.5;  // in the infrared, where no image told

struct ImageEvidence {
  FloorEvidence floor;
  std::vector<float> floor_albedo, other_albedo;
};

struct ShotRef {
  const Shot* shot;
  const DepthOptics* optics;
};

// Albedo of a shot's cells: by its infrared image where that has the model's scale, else a usual one.
std::vector<float> shot_albedo(const SurfaceCells& cells, const Shot& shot, const Multipath& known) {
  return known.infrared_scaled && !shot.ir.empty() ? albedo_of(cells, known.signal_counts)
                                                   : assumed_albedo(cells, known);
}

ImageEvidence look_at_shot(const ShotRef& ref, const Multipath& known) {
  const SurfaceCells cells = surface_cells(ref.shot->depth_mm, ref.shot->ir, *ref.optics);
  const auto albedo = shot_albedo(cells, *ref.shot, known);
  ImageEvidence result{floor_evidence(cells, bounce_errors_m(cells, bounced_light(cells, albedo))), {}, {}};
  for (int i = 0; i < cells.count(); ++i)
    if (cells.z[i] > 0 && cells.z[i] < kNear)
      (result.floor.is_floor[i] ? result.floor_albedo : result.other_albedo).push_back(albedo[i]);
  return result;
}

// Whether infrared counts can be what the model says: rooms and people are neither black nor all white.
bool has_scale(const std::vector<ShotRef>& shots, double signal) {
  constexpr float kBlack = 0.01f, kWhite = 0.99f;
  constexpr double kMost = 0.6;  // of the cells at either end
  std::vector<std::array<long, 3>> counts(shots.size());
  tbb::parallel_for(std::size_t{0}, shots.size(), [&](std::size_t i) {
    counts[i] = {0, 0, 0};
    if (shots[i].shot->ir.empty()) return;
    const SurfaceCells cells = surface_cells(shots[i].shot->depth_mm, shots[i].shot->ir, *shots[i].optics);
    const auto albedo = albedo_of(cells, signal);
    for (int k = 0; k < cells.count(); ++k) {
      if (cells.z[k] == 0) continue;
      ++counts[i][0];
      counts[i][1] += albedo[k] < kBlack;
      counts[i][2] += albedo[k] > kWhite;
    }
  });
  double all = 0, black = 0, white = 0;
  for (const auto& each : counts) all += each[0], black += each[1], white += each[2];
  return black <= kMost * all && white <= kMost * all;
}

// Images count by what they know, but none for all.
BounceStrength pooled(const std::vector<FloorEvidence>& floors, const OneBounceParams& params) {
  double sum = 0, weights = 0;
  BounceStrength result;
  for (const auto& floor : floors) {
    if (!floor.found) continue;
    const double weight = 1 / (floor.sigma * floor.sigma + kUneven * kUneven);
    sum += weight * floor.factor;
    weights += weight;
    ++result.images;
  }
  if (result.images == 0) return result;
  result.measured = sum / weights;
  result.sigma = 1 / std::sqrt(weights);
  const bool plausible = result.measured >= params.least_evidence && result.measured <= params.most_evidence;
  if (plausible && result.measured > kSure * result.sigma) result.factor = params.factor;
  return result;
}

std::vector<ShotRef> shots_of(const std::map<std::string, Shot>& shots, const SensorOptics& optics) {
  std::vector<ShotRef> result;
  for (const auto& [sensor, shot] : shots) {
    const auto own = optics.find(sensor);
    if (own != optics.end() && !shot.depth_mm.empty()) result.push_back({&shot, &own->second});
  }
  return result;
}

BounceStrength strength_of(const DepthScan& scan, const DepthOptics& optics, const Multipath& known,
                           const OneBounceParams& params) {
  const int frames = static_cast<int>(scan.depth_mm.size()), looked_at = std::min(frames, params.scan_frames);
  std::vector<FloorEvidence> floors(looked_at);
  tbb::parallel_for(0, looked_at, [&](int k) {
    const int frame = static_cast<int>(static_cast<long long>(k) * frames / looked_at);
    const SurfaceCells cells = surface_cells(scan.depth_mm[frame], {}, optics);
    floors[k] = floor_evidence(cells, bounce_errors_m(cells, bounced_light(cells, assumed_albedo(cells, known))));
  });
  return pooled(floors, params);
}

std::vector<ImageEvidence> look_at(const std::vector<ShotRef>& shots, const Multipath& known) {
  std::vector<ImageEvidence> seen(shots.size());
  tbb::parallel_for(std::size_t{0}, shots.size(), [&](std::size_t i) { seen[i] = look_at_shot(shots[i], known); });
  return seen;
}

double median_albedo(const std::vector<ImageEvidence>& seen, std::vector<float> ImageEvidence::*albedo) {
  std::vector<float> all;
  for (const auto& each : seen) all.insert(all.end(), (each.*albedo).begin(), (each.*albedo).end());
  return all.empty() ? kUsualAlbedo : median(std::move(all));
}

// One bounce between what each image itself shows. How much of it there is, the floor tells: no other sensor, no pose
// and no model is asked, and an image whose floor is as flat as it should be is left alone. What a surface sends on:
// Fuchs, "Multipath interference compensation in time-of-flight camera images", ICPR 2010.
Multipath one_bounce(const CaptureSession& session, const Calibration& calibration, const OneBounceParams& params) {
  const SensorOptics optics = time_of_flight_optics(calibration);
  const auto naked_shots = shots_of(session.naked, optics), dressed_shots = shots_of(session.dressed, optics);
  Multipath result;
  result.signal_counts = params.signal;
  result.floor_albedo = result.other_albedo = kUsualAlbedo;
  result.infrared_scaled = has_scale(naked_shots, params.signal) && has_scale(dressed_shots, params.signal);
  const auto naked = look_at(naked_shots, result), dressed = look_at(dressed_shots, result);
  std::vector<FloorEvidence> floors;
  for (const auto* shots : {&naked, &dressed})
    for (const auto& each : *shots) floors.push_back(each.floor);
  result.shots = pooled(floors, params);
  // The naked shots alone: captures of other clothes on the same mannequin share its scan.
  result.floor_albedo = median_albedo(naked, &ImageEvidence::floor_albedo);
  result.other_albedo = median_albedo(naked, &ImageEvidence::other_albedo);
  for (const auto& [name, scan] : session.scans) {
    const auto own = optics.find(scan.sensor);
    if (own != optics.end()) result.scans[name] = strength_of(scan, own->second, result, params);
  }
  return result;
}

const EstimateMultipath::Variant one_bounce_variant{"one_bounce", one_bounce};

}  // namespace
}  // namespace dressform
