#include "synthetic/body/scan_path.h"

#include <algorithm>
#include <cmath>

#include "scenes/random.h"

namespace dressform {
namespace {

constexpr double overlap_turns = 1.06;  // the last frames see again what the first saw

// Smooth noise of about unit amplitude along the path: slow waves with seeded phases.
double sway(Seed seed, const char* what, double turn) {
  double sum = 0;
  for (int wave = 0; wave < 4; ++wave) {
    const auto random = uniform4(seed, stream_of(what), wave);
    sum += std::sin(2 * M_PI * ((3 + 4 * wave + 2 * random[0]) * turn + random[1])) / (1 + 0.5 * wave);
  }
  return sum / 1.6;
}

Isometry3d looking_at(const Vector3d& eye, const Vector3d& target, double roll_rad) {
  const Vector3d forward = (target - eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitY()).normalized();
  Isometry3d world_from_sensor = Isometry3d::Identity();
  world_from_sensor.linear().col(0) = right;
  world_from_sensor.linear().col(1) = forward.cross(right);
  world_from_sensor.linear().col(2) = forward;
  world_from_sensor.linear() *= Eigen::AngleAxisd(roll_rad, Vector3d::UnitZ()).toRotationMatrix();
  world_from_sensor.translation() = eye;
  return world_from_sensor;
}

Vector3d random_direction(double a, double b) {
  const double z = 2 * a - 1, angle = 2 * M_PI * b, flat = std::sqrt(std::max(0.0, 1 - z * z));
  return {flat * std::cos(angle), flat * std::sin(angle), z};
}

}  // namespace

std::vector<Isometry3d> make_scan_path(const ScanSpec& scan, double body_height_m, Seed seed) {
  std::vector<Isometry3d> path;
  const auto start = uniform4(seed, stream_of("scan_start"), 0);
  for (int frame = 0; frame < scan.frames; ++frame) {
    const double turn = overlap_turns * frame / std::max(1, scan.frames - 1);
    const double angle = 2 * M_PI * (turn + 0.02 * (start[0] - 0.5)) + 0.006 * sway(seed, "angle", turn);
    const double radius = scan.radius_m + 0.05 * sway(seed, "radius", turn);
    // Three rises and stoops a round, each of whole periods, so that the loop closes.
    const double rise = std::sin(2 * M_PI * (3 * turn + start[1]));
    const double height = scan.height_m + 0.33 * rise + 0.015 * sway(seed, "height", turn);
    const Vector3d eye(radius * std::sin(angle), height, radius * std::cos(angle));
    const Vector3d target(0.03 * sway(seed, "aim_x", turn),
                          0.5 * body_height_m + 0.05 + 0.1 * rise + 0.03 * sway(seed, "aim_y", turn),
                          0.03 * sway(seed, "aim_z", turn));
    path.push_back(looking_at(eye, target, 0.025 * sway(seed, "roll", turn)));
  }
  return path;
}

std::map<std::string, Isometry3d> perturbed_rig(const std::vector<SensorSpec>& rig, const PriorSpec& prior, Seed seed) {
  std::map<std::string, Isometry3d> result;
  for (const auto& sensor : rig) {
    const std::uint64_t stream = stream_of(("prior " + sensor.name).c_str());
    const auto amount = normal4(seed, stream, 0);
    const auto direction = uniform4(seed, stream, 1);
    const double angle_deg = prior.rotation_deg * std::clamp(amount[0], -2.0, 2.0);
    const double step_m = prior.translation_m * std::clamp(amount[1], -2.0, 2.0);
    Isometry3d rough = sensor.world_from_sensor;
    rough.linear() =
        Eigen::AngleAxisd(angle_deg * M_PI / 180, random_direction(direction[0], direction[1])).toRotationMatrix() *
        sensor.world_from_sensor.linear();
    rough.translation() += step_m * random_direction(direction[2], direction[3]);
    result[sensor.name] = rough;
  }
  return result;
}

}  // namespace dressform
