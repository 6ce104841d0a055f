#include <tbb/parallel_for.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/extract/body_region.h"
#include "pipeline/extract/color_outline.h"
#include "pipeline/extract/extract.h"
#include "pipeline/geometry/axes_crossing.h"
#include "pipeline/geometry/floor.h"
#include "pipeline/imaging/color_mapping.h"
#include "scenes/random.h"

namespace dressform {
namespace {

struct ClusterParams {
  double jump_mm = 30;
  double radius_m = 0.7;
  double floor_tolerance_m = 0.02;
  double floor_margin_m = 0.025;
  double floor_tilt_deg = 20;
  double band_px = 6;
  double smoothness = 5;
};
template <class V>
void fields(V& v, ClusterParams& p) {
  v("jump_mm", p.jump_mm, 5, 200, "mm", "depth difference of neighbours that parts two pieces");
  v("radius_m", p.radius_m, 0.3, 1.5, "m", "of the upright cylinder that holds body and clothes");
  v("floor_tolerance_m", p.floor_tolerance_m, 0.002, 0.1, "m", "distance of the floor's inliers");
  v("floor_margin_m", p.floor_margin_m, 0.005, 0.2, "m", "what is nearer to the floor than this is floor");
  v("floor_tilt_deg", p.floor_tilt_deg, 2, 60, "deg", "largest angle between the floor and the sensor's horizon");
  v("band_px", p.band_px, 1, 40, "px", "how far colour may move the depth's outline, at 1920 x 1080");
  v("smoothness", p.smoothness, 0, 50, "nats", "price of an outline through even colour");
}

// Where the rig was meant to look, world frame.
std::optional<Vector3d> crossing_of_axes(const RigPrior& prior, const std::vector<std::string>& sensors) {
  std::vector<Isometry3d> poses;
  for (const std::string& sensor : sensors)
    if (const auto pose = prior.world_from_sensor.find(sensor); pose != prior.world_from_sensor.end())
      poses.push_back(pose->second);
  return axes_crossing(poses);
}

constexpr double kUsualStature_m = 1.8;  // where the naked model is empty
constexpr double kUnknownBands = 4;      // bands from the body within which a place without depth may still be the body

// Height of the body; where the scan saw no floor, of as much of it as was scanned.
double stature_of(const BodyModel& naked) {
  double low = 1e9, high = -1e9;
  for (const Vector3d& v : naked.body.vertices) {
    low = std::min(low, v.y());
    high = std::max(high, v.y());
  }
  return high <= low ? kUsualStature_m : naked.floor_seen ? high - std::min(low, 0.0) : high - low;
}

ViewMasks no_masks(const SensorCalibration& sensor) {
  const auto empty = [](const Camera& camera) { return cv::Mat(cv::Mat::zeros(camera.height, camera.width, CV_8U)); };
  ViewMasks masks;
  masks.naked = empty(sensor.ir);
  masks.dressed = empty(sensor.ir);
  if (!sensor.color) return masks;
  masks.naked_color = empty(*sensor.color);
  masks.dressed_color = empty(*sensor.color);
  return masks;
}

struct Task {
  std::string sensor;
  const SensorCalibration* calibration = nullptr;
  const Shot *naked = nullptr, *dressed = nullptr;
  BodyExpectation expected;
  ViewMasks masks;
  std::optional<Eigen::Vector4d> floor;
};

std::vector<Task> tasks_of(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked) {
  std::optional<Vector3d> place;
  if (session.prior) place = crossing_of_axes(*session.prior, session.sensors);
  std::vector<Task> tasks;
  for (const std::string& sensor : session.sensors) {
    const auto found = calibration.sensors.find(sensor);
    if (found == calibration.sensors.end())
      throw InputError("calibration.json: sensors", "found none for \"" + sensor + "\"; expected one for every view");
    Task task;
    task.sensor = sensor;
    task.calibration = &found->second;
    if (const auto shot = session.naked.find(sensor); shot != session.naked.end()) task.naked = &shot->second;
    if (const auto shot = session.dressed.find(sensor); shot != session.dressed.end()) task.dressed = &shot->second;
    task.expected.stature_m = stature_of(naked);
    if (session.prior && session.prior->world_from_sensor.count(sensor)) {
      const Isometry3d sensor_from_world = session.prior->world_from_sensor.at(sensor).inverse();
      task.expected.up = sensor_from_world.linear().col(1);
      // The turn of the sensor itself moves the place sideways: 10 degrees are 0.37 m at 2.1 m.
      if (place) task.expected.place = sensor_from_world * *place;
    }
    task.masks = no_masks(found->second);
    tasks.push_back(task);
  }
  return tasks;
}

// The body on the depth grid; finds the floor on the way.
BodyRegion region_of(const Shot& shot, const cv::Mat& depth_mm, Task& task, const ClusterParams& params, Seed seed) {
  const cv::Mat points = depth_points_m(depth_mm, task.calibration->ir);
  FloorSearch search;
  search.up = task.expected.up;
  search.tilt_deg = params.floor_tilt_deg;
  search.tolerance_m = params.floor_tolerance_m;
  const auto floor = find_floor(points, search, seed, stream_of("extract.floor"));
  BodyExpectation expected = task.expected;
  if (floor) {
    task.floor = expected.floor = floor;
    expected.up = floor->head<3>();
  }
  return find_body(depth_mm, points, shot.body_index, expected,
                   {params.jump_mm, params.radius_m, params.floor_margin_m});
}

void run(Task& task, const ClusterParams& params, Seed seed) {
  const OutlineParams outline{params.band_px, kUnknownBands * params.band_px, params.smoothness};
  const bool has_color = task.calibration->color.has_value();
  if (task.naked) {
    const cv::Mat depth = corrected_depth_mm(task.naked->depth_mm, *task.calibration);
    const BodyRegion region = region_of(*task.naked, depth, task, params, seed);
    task.masks.naked = region.mask;
    task.masks.found_naked = region.found;
    if (has_color && !task.naked->color.empty())
      task.masks.naked_color = color_outline(task.naked->color, depth, region.mask, *task.calibration, outline);
  }
  if (task.dressed) {
    const cv::Mat depth = corrected_depth_mm(task.dressed->depth_mm, *task.calibration);
    const BodyRegion region = region_of(*task.dressed, depth, task, params, seed);
    task.masks.dressed = region.mask;
    task.masks.found_dressed = region.found;
    if (!has_color || task.dressed->color.empty()) return;
    const bool reference = task.masks.found_naked && !task.naked->color.empty();
    const Background background{reference ? task.naked->color : cv::Mat(), task.masks.naked_color};
    task.masks.dressed_color = color_outline(task.dressed->color, depth, region.mask, *task.calibration, outline,
                                             reference ? &background : nullptr);
  }
}

// The mannequin as the connected pieces of depth that stand where the rig looks, its outline redrawn in colour by a
// minimum cut (Boykov and Jolly, ICCV 2001; local colour models in the manner of Rother et al., "GrabCut", SIGGRAPH
// 2004).
ExtractedViews cluster(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                       const ClusterParams& params, Seed seed) {
  auto tasks = tasks_of(session, calibration, naked);
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t k) { run(tasks[k], params, seed); });
  ExtractedViews result;
  for (Task& task : tasks) {
    result.views[task.sensor] = task.masks;
    if (task.floor) result.floor_in_sensor[task.sensor] = *task.floor;
  }
  return result;
}

const Extract::Variant cluster_variant{"cluster", cluster};

}  // namespace
}  // namespace dressform
