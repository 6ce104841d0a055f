#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/multipath/apply.h"
#include "pipeline/multipath/floor_evidence.h"

namespace dressform {
namespace {

struct OneBounceParams {
  double signal = 1300;
  double least_evidence = 0.4, factor = 1;
  int scan_frames = 30;
};

template <class V>
void fields(V& v, OneBounceParams& p) {
  v("signal", p.signal, 1.0, 1e6, "counts", "infrared amplitude of a white surface that faces the sensor at 1 m");
  v("least_evidence", p.least_evidence, 0.0, 10.0, "",
    "of the predicted bend of floors (1: all of it), below which nothing is corrected");
  v("factor", p.factor, 0.0, 3.0, "", "on predicted errors");
  v("scan_frames", p.scan_frames, 3, 1000, "", "frames of a scan whose floor is looked at");
}

struct ImageEvidence {
  FloorEvidence floor;
  std::vector<float> floor_albedo, other_albedo;
};

struct ShotRef {
  const Shot* shot;
  const DepthOptics* optics;
};

ImageEvidence look_at_shot(const ShotRef& ref, double signal) {
  const SurfaceCells cells = surface_cells(ref.shot->depth_mm, ref.shot->ir, *ref.optics);
  const auto albedo = albedo_of(cells, signal);
  ImageEvidence result{floor_evidence(cells, bounce_errors_m(cells, bounced_light(cells, albedo))), {}, {}};
  constexpr float kNear = 3;  // metres: the body rather than walls
  for (int i = 0; i < cells.count(); ++i)
    if (cells.z[i] > 0 && cells.z[i] < kNear)
      (result.floor.is_floor[i] ? result.floor_albedo : result.other_albedo).push_back(albedo[i]);
  return result;
}

double median_or(std::vector<float> values, double otherwise) {
  if (values.empty()) return otherwise;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// Images count by what they know, but none for all: floors have other reasons to be uneven.
BounceStrength pooled(const std::vector<FloorEvidence>& floors, const OneBounceParams& params) {
  constexpr double kUneven = 0.2;
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
  if (result.measured >= params.least_evidence && result.measured > 3 * result.sigma) result.factor = params.factor;
  return result;
}

std::vector<ShotRef> shots_of(const std::map<std::string, Shot>& shots, const SensorOptics& optics) {
  std::vector<ShotRef> result;
  for (const auto& [sensor, shot] : shots) {
    const auto own = optics.find(sensor);
    if (own != optics.end() && !shot.depth_mm.empty() && !shot.ir.empty()) result.push_back({&shot, &own->second});
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

// One bounce between what each image itself shows. How much of it there is, the floor tells: no other sensor, no pose
// and no model is asked, and an image whose floor is as flat as it should be is left alone.
Multipath one_bounce(const CaptureSession& session, const Calibration& calibration, const OneBounceParams& params) {
  const SensorOptics optics = time_of_flight_optics(calibration);
  auto shots = shots_of(session.naked, optics);
  const std::size_t naked = shots.size();
  const auto dressed = shots_of(session.dressed, optics);
  shots.insert(shots.end(), dressed.begin(), dressed.end());
  std::vector<ImageEvidence> seen(shots.size());
  tbb::parallel_for(std::size_t{0}, shots.size(),
                    [&](std::size_t i) { seen[i] = look_at_shot(shots[i], params.signal); });
  Multipath result;
  result.signal_counts = params.signal;
  std::vector<FloorEvidence> floors;
  for (const auto& each : seen) floors.push_back(each.floor);
  result.shots = pooled(floors, params);
  // The naked shots alone: captures of other clothes on the same mannequin share its scan.
  std::vector<float> floor_albedo, other_albedo;
  for (std::size_t i = 0; i < naked; ++i) {
    floor_albedo.insert(floor_albedo.end(), seen[i].floor_albedo.begin(), seen[i].floor_albedo.end());
    other_albedo.insert(other_albedo.end(), seen[i].other_albedo.begin(), seen[i].other_albedo.end());
  }
  constexpr double kUsual = 0.5;
  result.floor_albedo = median_or(std::move(floor_albedo), kUsual);
  result.other_albedo = median_or(std::move(other_albedo), kUsual);
  for (const auto& [name, scan] : session.scans) {
    const auto own = optics.find(scan.sensor);
    if (own != optics.end()) result.scans[name] = strength_of(scan, own->second, result, params);
  }
  return result;
}

const EstimateMultipath::Variant one_bounce_variant{"one_bounce", one_bounce};

}  // namespace
}  // namespace dressform
