#include "pipeline/multipath/apply.h"

#include <tbb/parallel_for.h>

#include "pipeline/multipath/bounce_pixels.h"
#include "scenes/devices/device.h"

namespace dressform {
namespace {

bool by_time_of_flight(const SensorCalibration& sensor) {
  const SensorDevice* device = find_device(sensor.model);
  return device && device->time_of_flight;
}

void correct_shots(std::map<std::string, Shot>& shots, const SensorOptics& optics, const Multipath& multipath) {
  std::vector<std::pair<Shot*, const DepthOptics*>> each;
  for (auto& [sensor, shot] : shots) {
    const auto own = optics.find(sensor);
    if (own != optics.end() && !shot.depth_mm.empty()) each.emplace_back(&shot, &own->second);
  }
  tbb::parallel_for(std::size_t{0}, each.size(), [&](std::size_t i) {
    const auto& [shot, own] = each[i];
    const bool lit = multipath.infrared_scaled && !shot->ir.empty();
    const SurfaceCells cells = surface_cells(shot->depth_mm, shot->ir, *own);
    const BouncedLight light =
        bounced_light(cells, lit ? albedo_of(cells, multipath.signal_counts) : assumed_albedo(cells, multipath));
    const PixelLight pixels = lit ? PixelLight{shot->ir, multipath.signal_counts} : PixelLight{};
    shot->depth_mm = without_bounce(shot->depth_mm, cells, light, pixels, *own, multipath.shots.factor);
  });
}

}  // namespace

SensorOptics time_of_flight_optics(const Calibration& calibration) {
  SensorOptics result;
  for (const auto& [name, sensor] : calibration.sensors)
    if (by_time_of_flight(sensor)) result.emplace(name, DepthOptics(sensor));
  return result;
}

std::vector<float> assumed_albedo(const SurfaceCells& cells, const Multipath& known) {
  std::vector<float> result(cells.count(), 0.0f);
  constexpr float kFacesUp = -0.85f;  // image y runs downwards
  for (int i = 0; i < cells.count(); ++i)
    if (cells.z[i] > 0)
      result[i] = static_cast<float>(cells.normal_y[i] < kFacesUp ? known.floor_albedo : known.other_albedo);
  return result;
}

CaptureSession without_multipath(const CaptureSession& session, const Calibration& calibration,
                                 const Multipath& multipath) {
  CaptureSession result = session;
  const SensorOptics optics = time_of_flight_optics(calibration);
  correct_shots(result.naked, optics, multipath);
  correct_shots(result.dressed, optics, multipath);
  return result;
}

DepthScan without_multipath(const DepthScan& scan, const SensorCalibration& calibration, const Multipath& multipath,
                            const BounceStrength& strength) {
  DepthScan result{scan.sensor, std::vector<cv::Mat>(scan.depth_mm.size()), scan.world_from_frame};
  const DepthOptics optics(calibration);
  tbb::parallel_for(std::size_t{0}, scan.depth_mm.size(), [&](std::size_t i) {
    const SurfaceCells cells = surface_cells(scan.depth_mm[i], {}, optics);
    const BouncedLight light = bounced_light(cells, assumed_albedo(cells, multipath));
    result.depth_mm[i] = without_bounce(scan.depth_mm[i], cells, light, {}, optics, strength.factor);
  });
  return result;
}

}  // namespace dressform
