#include "pipeline/fuse/turning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kDegrees = 180 / M_PI;
constexpr double kTurned_deg = 60;  // less shows one side of a body: no scan of it

constexpr int kLooked = 40, kStride = 3;  // frames and pixels that are compared
constexpr double kMoves_m = 0.10;         // a pixel's depth comes and goes by this: an outline passed over it
constexpr double kStays = 0.03;           // of the depth: noise and shaking hands
constexpr double kLeastMoving = 0.003, kLeastStaying = 0.1;  // of the pixels
constexpr double kBehind_m = 0.35;  // the moving thing's far side, as seen from the outline's near one

struct PixelChange {
  double near_m = 0, far_m = 0;
  bool seen = false;
};

PixelChange change_at(const DepthScan& scan, const std::vector<int>& frames, int x, int y) {
  std::vector<double> depths;
  for (const int i : frames)
    if (const int mm = scan.depth_mm[i].at<std::uint16_t>(y, x); mm > 0) depths.push_back(1e-3 * mm);
  if (2 * depths.size() < frames.size()) return {};
  PixelChange change;
  change.near_m = lower_quantile(depths, 0.1);
  change.far_m = lower_quantile(depths, 0.9);
  change.seen = true;
  return change;
}

Vector3d upwards(const Track& track) {
  Vector3d up = Vector3d::Zero();
  for (std::size_t i = 0; i < track.world_from_frame.size(); ++i)
    if (track.tracked[i]) up -= track.world_from_frame[i].linear().col(1);
  return up.normalized();
}

}  // namespace

double turned_deg(const Track& track, const Vector3d& up) {
  const Vector3d side = up.unitOrthogonal(), ahead = up.cross(side);
  double heading = 0, before = 0, least = 0, most = 0;
  bool first = true;
  for (std::size_t i = 0; i < track.world_from_frame.size(); ++i) {
    if (!track.tracked[i]) continue;
    const Vector3d axis = track.world_from_frame[i].linear().col(2);
    const double now = std::atan2(axis.dot(side), axis.dot(ahead));
    if (!first) heading += std::remainder(now - before, 2 * M_PI);
    first = false;
    before = now;
    least = std::min(least, heading);
    most = std::max(most, heading);
  }
  return kDegrees * (most - least);
}

std::optional<double> depth_of_moving(const DepthScan& scan, const SensorCalibration& calibration) {
  std::vector<int> frames;
  const int count = static_cast<int>(scan.depth_mm.size()), looked = std::min(count, kLooked);
  for (int k = 0; k < looked; ++k) frames.push_back(static_cast<int>(static_cast<long long>(k) * count / looked));
  std::vector<double> moving_near, moving_far;
  int seen = 0, staying = 0;
  for (int y = 0; y < calibration.ir.height; y += kStride)
    for (int x = 0; x < calibration.ir.width; x += kStride) {
      const PixelChange change = change_at(scan, frames, x, y);
      if (!change.seen) continue;
      ++seen;
      staying += change.far_m - change.near_m < kStays * change.far_m;
      if (change.far_m - change.near_m <= kMoves_m) continue;
      moving_near.push_back(change.near_m);
      moving_far.push_back(change.far_m);
    }
  if (moving_near.empty() || static_cast<double>(moving_near.size()) < kLeastMoving * seen ||
      staying < kLeastStaying * seen)
    return {};
  const double limit_m = lower_quantile(moving_near, 0.9) + kBehind_m;
  return limit_m < lower_quantile(moving_far, 0.5) ? std::optional(limit_m) : std::nullopt;
}

FollowedScan followed_scan(const DepthScan& scan, const SensorCalibration& calibration, const FuseScanOptions& options,
                           const Follow& follow) {
  const auto followed = [&](const FuseScanOptions& with) {
    FollowedScan result{checked_frames(scan, calibration, with), {}, with, 0, {}};
    result.track = follow(result.frames, Projector(result.frames.first_usable().camera));
    result.turned_deg = turned_deg(result.track, upwards(result.track));
    return result;
  };
  FollowedScan all = followed(options);
  if (all.turned_deg >= kTurned_deg) return all;
  all.note = fmt::format(
      "nothing turned: sensor and scene went {:.0f} degrees round one another, so that one side is seen (walk round "
      "the "
      "body, or let it turn before the sensor)",
      all.turned_deg);
  const auto limit_m = depth_of_moving(scan, calibration);
  if (!limit_m) return all;
  FuseScanOptions nearer = options;
  nearer.max_depth_m = std::max(1.0, *limit_m);
  FollowedScan moving = followed(nearer);
  if (moving.turned_deg < kTurned_deg || 2 * moving.track.count_tracked() < moving.frames.count()) return all;
  moving.note = fmt::format(
      "the sensor stood still and something turned {:.0f} degrees before it: that was taken for the body, and all "
      "beyond "
      "{:.2f} m, which stayed, was left out",
      moving.turned_deg, nearer.max_depth_m);
  return moving;
}

BodyModel fuse_followed(const DepthScan& scan, const SensorCalibration& calibration, const FollowedScan& followed) {
  BodyModel model = fuse_tracked(scan, followed.frames, followed.track, calibration, followed.options);
  model.turned_deg = followed.turned_deg;
  model.note = followed.note;
  if (const double factor = followed.frames.noise_factor; factor > 1)
    model.note += (model.note.empty() ? "" : "; ") +
                  fmt::format("depth is {:.1f} times as noisy as is usual for its distance", factor);
  if (!model.floor_seen)
    model.note += (model.note.empty() ? "" : "; ") +
                  std::string("no floor was seen: upright is as the sensor was held, and heights have no zero");
  model.converged = model.converged && followed.turned_deg >= kTurned_deg;
  return model;
}

}  // namespace dressform
