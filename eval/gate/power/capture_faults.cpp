// Faults in what the sensors recorded and in how their cameras are known.
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/gate/power/fault.h"
#include "eval/gate/power/fault_shapes.h"
#include "pipeline/calibrate/calibrate.h"
#include "pipeline/multipath/multipath.h"

namespace dressform {
namespace {

Fault session_fault(const std::string& name, const std::string& unit, std::vector<double> sizes,
                    const std::string& what, void (*edit)(Shot&, double size, const Placement&)) {
  Fault fault{"capture", name, unit, std::move(sizes), what, {}, {}, {}, {}, {}};
  fault.on_capture = [edit](CaptureSession& session, double size, const Placement& place) {
    const std::string sensor = place.one_of(session.dressed);
    for (auto* shots : {&session.naked, &session.dressed})
      if (const auto found = shots->find(sensor); found != shots->end()) edit(found->second, size, place);
  };
  return fault;
}

void lengthen_depth(Shot& shot, double size_mm, const Placement&) {
  const cv::Mat seen = shot.depth_mm > 0;
  cv::add(shot.depth_mm, cv::Scalar(size_mm), shot.depth_mm, seen);
}

void add_depth_noise(Shot& shot, double size_mm, const Placement& place) {
  for (int y = 0; y < shot.depth_mm.rows; ++y)
    for (int x = 0; x < shot.depth_mm.cols; ++x)
      if (auto& value = shot.depth_mm.at<std::uint16_t>(y, x))
        value = cv::saturate_cast<std::uint16_t>(value + size_mm * place.normal(1000 + y * shot.depth_mm.cols + x));
}

void drop_depth(Shot& shot, double size_percent, const Placement& place) {
  for (int y = 0; y < shot.depth_mm.rows; ++y)
    for (int x = 0; x < shot.depth_mm.cols; ++x)
      if (100 * place.uniform(1000 + y * shot.depth_mm.cols + x) < size_percent)
        shot.depth_mm.at<std::uint16_t>(y, x) = 0;
}

void shift_color(Shot& shot, double size_px, const Placement&) {
  shift_image(shot.color, static_cast<int>(size_px), 0);
}
void brighten_color(Shot& shot, double size_percent, const Placement&) {
  multiply_image(shot.color, 1 + size_percent / 100);
}

// The cameras of one sensor of the rig. Of the hand-held one other faults tell (its scans).
SensorCalibration& one_sensor(Calibrated& calibrated, const Placement& place) {
  std::map<std::string, SensorCalibration> rig = calibrated.calibration.sensors;
  for (auto it = rig.begin(); it != rig.end();) it = it->second.color ? std::next(it) : rig.erase(it);
  return calibrated.calibration.sensors.at(place.one_of(rig.empty() ? calibrated.calibration.sensors : rig));
}

void lengthen_focal(Calibrated& calibrated, double size_percent, const Placement& place) {
  Camera& camera = one_sensor(calibrated, place).ir;
  camera.fx *= 1 + size_percent / 100;
  camera.fy *= 1 + size_percent / 100;
}

void move_color_camera(Calibrated& calibrated, double size_mm, const Placement& place) {
  one_sensor(calibrated, place).color_from_ir.pretranslate(size_mm / 1000 * place.direction(1));
}

void turn_color_camera(Calibrated& calibrated, double size_deg, const Placement& place) {
  one_sensor(calibrated, place).color_from_ir.prerotate(Eigen::AngleAxisd(size_deg * M_PI / 180, place.direction(1)));
}

void offset_depth(Calibrated& calibrated, double size_mm, const Placement& place) {
  one_sensor(calibrated, place).depth_offset_m += size_mm / 1000;
}

void strengthen_bounce(Multipath& multipath, double size_percent, const Placement&) {
  multipath.shots.factor += size_percent / 100;
}

}  // namespace

std::vector<Fault> capture_faults() {
  const std::string all_of_one = "of one sensor, naked and dressed";
  return {
      session_fault("depth_long", "mm", {3, 10, 30}, "depth measured too long, " + all_of_one, lengthen_depth),
      session_fault("depth_noise", "mm", {3, 10, 30}, "more noise of depth, " + all_of_one, add_depth_noise),
      session_fault("depth_dropped", "%", {5, 20, 60}, "pixels without depth, " + all_of_one, drop_depth),
      session_fault("color_shifted", "px", {2, 6, 15}, "colour image moved to the right, " + all_of_one, shift_color),
      session_fault("color_bright", "%", {5, 15, 40}, "colour image brighter, " + all_of_one, brighten_color),
      artifact_fault<Calibrated>("calibrate", "focal_long", "%", {0.5, 2, 6},
                                 "focal length of one infrared camera too long", lengthen_focal),
      artifact_fault<Calibrated>("calibrate", "color_moved", "mm", {2, 6, 20},
                                 "colour camera of one sensor placed elsewhere", move_color_camera),
      artifact_fault<Calibrated>("calibrate", "color_turned", "deg", {0.1, 0.4, 1.5},
                                 "colour camera of one sensor turned", turn_color_camera),
      artifact_fault<Calibrated>("calibrate", "depth_offset", "mm", {3, 10, 30}, "depth offset of one sensor wrong",
                                 offset_depth),
      artifact_fault<Multipath>("multipath", "stronger", "%", {20, 60, 200},
                                "bounced light taken off by so much more of its prediction", strengthen_bounce),
  };
}

}  // namespace dressform
