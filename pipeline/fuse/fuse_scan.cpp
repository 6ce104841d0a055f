#include "pipeline/fuse/fuse_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "pipeline/geometry/floor.h"
#include "scenes/random.h"
#include "scenes/small_solvers.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr Seed kFloorSeed = 20;                       // of the search's draws; another seed finds the same plane
constexpr double kTilt_deg = 30, kFinerTilt_deg = 3;  // of the floor against the sensors' mean upright, then the first
constexpr double kFinerBand_m = 0.01;                 // of the second plane's inliers
constexpr double kLevel = 0.8;                        // cosine from which a normal points up
constexpr double kSensorHeight_m = 1.2;               // of who walks round a body, where no floor was seen
constexpr double kTrunkFrom = 0.5, kTrunkTo = 0.8;    // of the body's height: the trunk, without legs and head

Vector3d mean_up(const Track& track) {
  Vector3d up = Vector3d::Zero();
  for (std::size_t i = 0; i < track.world_from_frame.size(); ++i)
    if (track.tracked[i]) up -= track.world_from_frame[i].linear().col(1);
  return up.normalized();
}

// Points of all tracked frames, every `stride`-th with a normal.
PointCloud scattered_points(const ScanFrames& frames, const std::vector<Isometry3d>& target_from_frame,
                            const std::vector<char>& used, int stride) {
  PointCloud cloud;
  for (int i = 0; i < frames.count(); ++i) {
    if (!used[i]) continue;
    const DepthMap& map = frames.maps[i];
    for (std::size_t k = i % stride; k < map.points.size(); k += stride) {
      if (!map.has_normal(static_cast<int>(k))) continue;
      cloud.points.push_back(target_from_frame[i] * map.points[k].cast<double>());
      cloud.normals.push_back(target_from_frame[i].linear() * map.normals[k].cast<double>());
    }
  }
  return cloud;
}

// A floor is wide and lies as far below the sensors as hands hold them; shoulders, a chair or a table are not.
bool is_floor(const Eigen::Vector4d& plane, const std::vector<Vector3d>& level, const Track& track) {
  constexpr double kOn_m = 0.02, kWide_m = 0.25;  // standard deviation across: of a metre of floor
  constexpr double kLowest_m = 0.3, kHighest_m = 3;
  const Vector3d up = plane.head<3>(), side = up.unitOrthogonal(), other = up.cross(side);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  int count = 0;
  for (const auto& p : level) {
    if (std::abs(up.dot(p) + plane[3]) > kOn_m) continue;
    const Eigen::Vector2d at(side.dot(p), other.dot(p));
    mean += at;
    square += at * at.transpose();
    ++count;
  }
  if (count == 0) return false;
  mean /= count;
  const Eigen::Matrix2d spread = square / count - mean * mean.transpose();
  const double root = std::sqrt(std::max(0.0, spread.trace() * spread.trace() / 4 - spread.determinant()));
  std::vector<double> heights;
  for (std::size_t i = 0; i < track.tracked.size(); ++i)
    if (track.tracked[i]) heights.push_back(up.dot(track.world_from_frame[i].translation()) + plane[3]);
  const double height = median(heights);
  return std::sqrt(std::max(0.0, spread.trace() / 2 - root)) > kWide_m && height > kLowest_m && height < kHighest_m;
}

std::optional<Eigen::Vector4d> floor_plane(const ScanFrames& frames, const Track& track) {
  constexpr int kStride = 61;
  FloorSearch search;
  search.up = mean_up(track);
  search.tilt_deg = kTilt_deg;
  const PointCloud cloud = scattered_points(frames, track.world_from_frame, track.tracked, kStride);
  std::vector<Vector3d> level;  // what faces upwards
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (cloud.normals[i].dot(search.up) > kLevel) level.push_back(cloud.points[i]);
  auto plane = find_floor(level, search, kFloorSeed, stream_of("fuse.floor"));
  if (!plane) return plane;
  search.up = plane->head<3>();
  search.tilt_deg = kFinerTilt_deg;
  search.tolerance_m = kFinerBand_m;
  if (const auto finer = find_floor(level, search, kFloorSeed, stream_of("fuse.floor.finer"))) plane = finer;
  if (!is_floor(*plane, level, track)) return {};
  return plane;
}

// y up, floor y = 0, the given point above the origin. Without a floor: the sensors' mean upright, and the lowest point
// is unknown, so that y = 0 is set below the sensors by their usual height.
Isometry3d model_from_world(const Track& track, const std::optional<Eigen::Vector4d>& floor) {
  const Vector3d up = floor ? Vector3d(floor->head<3>()) : mean_up(track), axis = axes_crossing(track);
  Isometry3d model = Isometry3d::Identity();
  model.linear() = rotation_between(up, Vector3d::UnitY());
  double height = 0;
  if (floor) {
    height = up.dot(axis) + (*floor)[3];
  } else {
    int count = 0;
    for (std::size_t i = 0; i < track.tracked.size(); ++i)
      if (track.tracked[i]) height += up.dot(axis - track.world_from_frame[i].translation()), ++count;
    height = height / std::max(1, count) + kSensorHeight_m;
  }
  model.translation() = Vector3d(0, height, 0) - model.linear() * axis;
  return model;
}

// Mean of points and normals in every cell of a regular grid, in the order of the cells: fine ones near the axis,
// coarse ones beyond.
PointCloud thinned(const PointCloud& cloud) {
  constexpr double kNear = 1.0, kFine = 0.012, kCoarse = 0.03;  // metres
  constexpr int kLeastPoints = 2;                               // in a cell: fewer are noise
  constexpr double kLeastAgreement = 0.7;                       // length of the mean normal: less is an edge
  struct Sum {
    Vector3d point = Vector3d::Zero(), normal = Vector3d::Zero();
    int count = 0;
  };
  std::map<std::array<int, 4>, Sum> cells;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const bool near = std::hypot(cloud.points[i].x(), cloud.points[i].z()) < kNear;
    const Vector3d at = cloud.points[i] / (near ? kFine : kCoarse);
    auto& sum = cells[{near ? 0 : 1, static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
                       static_cast<int>(std::floor(at.z()))}];
    sum.point += cloud.points[i];
    sum.normal += cloud.normals[i];
    ++sum.count;
  }
  PointCloud result;
  for (const auto& [cell, sum] : cells) {
    if (sum.count < kLeastPoints || sum.normal.norm() < kLeastAgreement * sum.count) continue;
    result.points.push_back(sum.point / sum.count);
    result.normals.push_back(sum.normal.normalized());
  }
  return result;
}

// Centre of the trunk, x and z.
Vector3d trunk_axis(const PointCloud& body) {
  double top = 0;
  for (const auto& p : body.points) top = std::max(top, p.y());
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (const auto& p : body.points)
    if (p.y() > kTrunkFrom * top && p.y() < kTrunkTo * top) sum += p, ++count;
  if (count == 0) return Vector3d::Zero();
  return Vector3d(sum.x() / count, 0, sum.z() / count);
}

void shift(BodyModel& model, const Vector3d& by) {
  for (auto& p : model.body.vertices) p += by;
  for (auto& p : model.surroundings.points) p += by;
  for (auto& pose : model.model_from_frame) pose.translation() += by;
}

}  // namespace

ScanFrames checked_frames(const DepthScan& scan, const SensorCalibration& calibration, const FuseScanOptions& options) {
  constexpr int kLeastFrames = 10;  // fewer show one side of a body at best
  ScanFrames frames = prepare_frames(scan, calibration, options.samples_per_direction, options.max_depth_m);
  const auto usable = std::count(frames.usable.begin(), frames.usable.end(), 1);
  if (usable < kLeastFrames)
    throw InputError("scan by " + scan.sensor, "found " + std::to_string(usable) + " frames with enough depth of " +
                                                   std::to_string(scan.depth_mm.size()) + "; expected at least " +
                                                   std::to_string(kLeastFrames));
  return frames;
}

BodyModel fuse_tracked(const DepthScan& scan, const ScanFrames& frames, const Track& track,
                       const SensorCalibration& calibration, const FuseScanOptions& options) {
  constexpr int kLeastObservations = 3, kSurroundingsStride = 5;
  BodyModel model;
  const auto floor = floor_plane(frames, track);
  const Isometry3d from_world = model_from_world(track, floor);
  for (const auto& pose : track.world_from_frame) model.model_from_frame.push_back(from_world * pose);
  VolumeRegion region;
  region.radius_m = options.region_radius_m;
  const BlockVolume volume(frames, calibration.ir, model.model_from_frame, track.tracked, region, options.volume);
  const PointCloud body = body_points(volume.surface_points(kLeastObservations), 0, 0, options.points);
  const ScanViews views{scan, calibration, model.model_from_frame, track.tracked};
  model.body = closed_body(body, options.surface, views);
  model.surroundings = thinned(scattered_points(frames, model.model_from_frame, track.tracked, kSurroundingsStride));
  shift(model, -trunk_axis(body));
  for (std::size_t i = 0; i < track.tracked.size(); ++i)
    if (!track.tracked[i]) model.model_from_frame[i].matrix().setConstant(std::numeric_limits<double>::quiet_NaN());
  model.frames_used = track.count_tracked();
  model.loop_closure_m = track.loop_closure_m;
  model.residual_rms_m = track.residual_rms_m;
  model.floor_seen = floor.has_value();
  model.converged = !model.body.triangles.empty() && model.frames_used > static_cast<int>(track.tracked.size()) / 2;
  return model;
}

}  // namespace dressform
