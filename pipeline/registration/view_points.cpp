#include "pipeline/registration/view_points.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/geometry/axes_crossing.h"
#include "pipeline/geometry/floor.h"
#include "pipeline/imaging/sensor_noise.h"
#include "scenes/random.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kCylinder = 0.8;     // metres about the body's axis that are body and clothes
constexpr double kAboveFloor = 0.03;  // what is lower is floor and stand
constexpr double kFloorBand = 0.05;   // of the floor's points, either way
constexpr double kLevel = 0.75;       // cosine: a rough prior may be 30 degrees off, and normals 10 more
constexpr double kOnFloor = 0.9;      // cosine of a floor point's normal once the floor is known
constexpr Seed kFloorSeed = 20;       // of the search's draws; another seed finds the same plane

std::vector<int> thinned(const std::vector<int>& all, int most) {
  if (static_cast<int>(all.size()) <= most) return all;
  std::vector<int> result;
  for (int k = 0; k < most; ++k) result.push_back(all[static_cast<std::size_t>(k) * all.size() / most]);
  return result;
}

std::optional<Vector3d> meant_place(const RigPrior& prior) {
  std::vector<Isometry3d> poses;
  for (const auto& [sensor, pose] : prior.world_from_sensor) poses.push_back(pose);
  return axes_crossing(poses);
}

// Where the thing in front of the sensor stands: on the optical axis, a little behind the nearer depths of the image's
// middle, of which the wall is a part.
std::optional<Vector3d> middle_of_image(const DepthMap& map) {
  constexpr double kHalfBody_m = 0.1;
  const auto depths = middle_depths_m(map);
  if (depths.empty()) return {};
  return Vector3d(0, 0, nth_value(depths, depths.size() / 4) + kHalfBody_m);
}

std::optional<Eigen::Vector4d> own_floor(const DepthMap& map, const std::optional<Isometry3d>& world_from_sensor) {
  FloorSearch search;
  if (world_from_sensor) search.up = world_from_sensor->linear().transpose() * Vector3d::UnitY();
  search.tilt_deg = 30;
  std::vector<Vector3d> level;
  for (std::size_t i = 0; i < map.points.size(); i += 3)
    if (map.has_normal(static_cast<int>(i)) && map.normals[i].cast<double>().dot(search.up) > kLevel)
      level.push_back(map.points[i].cast<double>());
  return find_floor(level, search, kFloorSeed, stream_of("registration.floor"));
}

struct Scene {
  const ExtractedViews& extracted;
  const CaptureSession& session;
  std::optional<Vector3d> place;  // of the mannequin, world frame
};

// Sorts the points of a view into body, floor and room.
void sort_points(const Scene& scene, ViewPoints& view, int most_points) {
  const auto found = scene.extracted.views.find(view.sensor);
  const bool masked = found != scene.extracted.views.end() && found->second.found_naked &&
                      found->second.naked.rows == view.map.camera.height &&
                      found->second.naked.cols == view.map.camera.width;
  std::optional<Vector3d> place = middle_of_image(view.map);
  if (scene.place && view.world_from_sensor) place = view.world_from_sensor->inverse() * *scene.place;
  const Vector3d up = view.floor_plane ? Vector3d(view.floor_plane->head<3>()) : Vector3d(0, -1, 0);
  std::vector<int> body, floor, room;
  for (int i = 0; i < static_cast<int>(view.map.points.size()); ++i) {
    if (!view.map.has_normal(i)) continue;
    const Vector3d p = view.map.points[i].cast<double>();
    const double height = view.floor_plane ? up.dot(p) + (*view.floor_plane)[3] : 1;
    bool is_body = false;
    if (masked) {
      is_body = found->second.naked.at<std::uint8_t>(i / view.map.camera.width, i % view.map.camera.width) != 0;
    } else if (place) {
      const Vector3d from_axis = p - *place;
      is_body = height > kAboveFloor && (from_axis - up * up.dot(from_axis)).norm() < kCylinder;
    }
    const bool is_floor =
        view.floor_plane && std::abs(height) < kFloorBand && view.map.normals[i].cast<double>().dot(up) > kOnFloor;
    (is_body ? body : is_floor ? floor : room).push_back(i);
  }
  view.body = thinned(body, most_points);
  view.floor = thinned(floor, most_points / 3);
  view.room = thinned(room, most_points / 2);
  std::vector<float> sigmas;
  for (const int i : view.body) sigmas.push_back(view.map.sigma_m[i]);
  view.body_sigma_m = median_or(std::move(sigmas), 0.0f);
}

ViewPoints one_view(const Scene& scene, const Calibration& calibration, const std::string& sensor, int most_points) {
  ViewPoints view;
  view.sensor = sensor;
  const auto shot = scene.session.naked.find(sensor);
  const auto own = calibration.sensors.find(sensor);
  if (shot == scene.session.naked.end() || own == calibration.sensors.end() || shot->second.depth_mm.empty())
    return view;
  DepthMapOptions options;
  options.noise_factor = view.noise_factor = depth_noise_factor({shot->second.depth_mm}, own->second.ir);
  view.map = make_depth_map(shot->second.depth_mm, own->second, options);
  if (scene.session.prior) {
    const auto prior = scene.session.prior->world_from_sensor.find(sensor);
    if (prior != scene.session.prior->world_from_sensor.end()) view.world_from_sensor = prior->second;
  }
  const auto floor = scene.extracted.floor_in_sensor.find(sensor);
  view.floor_plane = floor != scene.extracted.floor_in_sensor.end() ? std::optional(floor->second)
                                                                    : own_floor(view.map, view.world_from_sensor);
  sort_points(scene, view, most_points);
  return view;
}

}  // namespace

std::vector<ViewPoints> view_points(const CaptureSession& session, const Calibration& calibration,
                                    const ExtractedViews& extracted, int most_points) {
  Scene scene{extracted, session, {}};
  if (session.prior) scene.place = meant_place(*session.prior);
  std::vector<ViewPoints> views(session.sensors.size());
  tbb::parallel_for(std::size_t{0}, views.size(),
                    [&](std::size_t i) { views[i] = one_view(scene, calibration, session.sensors[i], most_points); });
  return views;
}

}  // namespace dressform
