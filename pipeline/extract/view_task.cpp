#include "pipeline/extract/view_task.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/geometry/axes_crossing.h"
#include "pipeline/geometry/floor.h"
#include "scenes/error.h"

namespace dressform {
namespace {

constexpr double kUsualStature_m = 1.8;  // where the naked model is empty

// Where the rig was meant to look, world frame.
std::optional<Vector3d> crossing_of_axes(const RigPrior& prior, const std::vector<std::string>& sensors) {
  std::vector<Isometry3d> poses;
  for (const std::string& sensor : sensors)
    if (const auto pose = prior.world_from_sensor.find(sensor); pose != prior.world_from_sensor.end())
      poses.push_back(pose->second);
  return axes_crossing(poses);
}

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

}  // namespace

std::vector<ViewTask> view_tasks(const CaptureSession& session, const Calibration& calibration,
                                 const BodyModel& naked) {
  std::optional<Vector3d> place;
  if (session.prior) place = crossing_of_axes(*session.prior, session.sensors);
  std::vector<ViewTask> tasks;
  for (const std::string& sensor : session.sensors) {
    const auto found = calibration.sensors.find(sensor);
    if (found == calibration.sensors.end())
      throw InputError("calibration.json: sensors", "found none for \"" + sensor + "\"; expected one for every view");
    ViewTask task;
    task.sensor = sensor;
    task.calibration = &found->second;
    if (const auto shot = session.naked.find(sensor); shot != session.naked.end()) task.naked = &shot->second;
    if (const auto shot = session.dressed.find(sensor); shot != session.dressed.end()) task.dressed = &shot->second;
    task.expected.stature_m = stature_of(naked);
    if (session.prior && session.prior->world_from_sensor.count(sensor)) {
      const Isometry3d& world_from_sensor = session.prior->world_from_sensor.at(sensor);
      const Isometry3d sensor_from_world = world_from_sensor.inverse();
      task.expected.up = sensor_from_world.linear().col(1);
      // The turn of the sensor itself moves the place sideways: 10 degrees are 0.37 m at 2.1 m.
      if (place) task.expected.place = sensor_from_world * *place;
      const Vector3d out = world_from_sensor.translation() - place.value_or(Vector3d::Zero());
      task.azimuth_deg = std::atan2(out.x(), out.z()) * 180 / M_PI;  // the mannequin faces the world's +z
    }
    task.masks = no_masks(found->second);
    tasks.push_back(task);
  }
  return tasks;
}

std::optional<Eigen::Vector4d> floor_of_view(const cv::Mat& points_m, const ViewFloorParams& params, ViewTask& task,
                                             Seed seed) {
  FloorSearch search;
  search.up = task.expected.up;
  search.tilt_deg = params.tilt_deg;
  search.tolerance_m = params.tolerance_m;
  const auto floor = find_floor(points_m, search, seed, stream_of("extract.floor"));
  if (floor) task.floor = floor;
  return floor;
}

ExtractedViews extracted_views(const std::vector<ViewTask>& tasks) {
  ExtractedViews result;
  for (const ViewTask& task : tasks) {
    result.views[task.sensor] = task.masks;
    if (task.floor) result.floor_in_sensor[task.sensor] = *task.floor;
  }
  return result;
}

}  // namespace dressform
