#include "scenes/session_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scenes/length_units.h"

namespace dressform {
namespace {

// Fields of view of 2 atan(1 / (2 f)): 11 to 157 degrees. Kinects have 60 to 84, the widest time-of-flight camera 120.
constexpr double kLeastFocalOfWidth = 0.1, kMostFocalOfWidth = 5;
constexpr double kMostAspect = 1.5;      // fx / fy; scaled images have 1.01, and no depth camera has more than 1.1
constexpr double kMostDistortion = 100;  // any coefficient: calibrations from few boards reach 10
constexpr double kMostStep_m = 0.5;      // between colour and infrared: 15 to 110 mm in depth cameras
constexpr double kMostOffset_m = 0.2;    // of measured depth: up to 30 mm in Kinects
constexpr double kMostDistance_m = 15;   // of a sensor from the mannequin: depth cameras see 10 m at most
constexpr double kLeastHeight_m = -0.5, kMostHeight_m = 5;  // above the floor: a rough prior may err, a room ends
constexpr double kMostSigma_m = 3;                          // of a prior that says anything about a room
constexpr double kMissed_m = 1.0;  // the optical axis passes the mannequin this far off: it is not looked at
constexpr double kLeastSquare_m = 0.004, kMostSquare_m = 0.25, kMostBoard_m = 2.5;

FieldProblem problem(std::string field, std::string text) { return {std::move(field), std::move(text)}; }

std::optional<FieldProblem> focal_problem(const char* name, double focal, int width) {
  if (focal <= 0)
    return problem(name, fmt::format("found {:g} px; expected a positive focal length (an axis that runs the other way "
                                     "is put right in the images)",
                                     focal));
  if (focal < kLeastFocalOfWidth * width)
    return problem(name,
                   fmt::format("found {:g} px for images {} px wide; expected a focal length of {:.0f} to {:.0f} "
                               "px (looks like {}: pixels are meant)",
                               focal, width, kLeastFocalOfWidth * width, kMostFocalOfWidth * width,
                               focal < 3 ? "a part of the width" : "millimetres, or the camera of smaller images"));
  if (focal > kMostFocalOfWidth * width)
    return problem(name, fmt::format("found {:g} px for images {} px wide; expected a focal length of {:.0f} to {:.0f} "
                                     "px, that of images of this size",
                                     focal, width, kLeastFocalOfWidth * width, kMostFocalOfWidth * width));
  return {};
}

std::optional<FieldProblem> center_problem(const char* name, double center, int size) {
  if (center >= -0.5 && center <= size - 0.5) return {};
  return problem(name, fmt::format("found a principal point at {:g} px, outside the image of {} px; expected that of "
                                   "images of this size (of a crop: less the crop's corner)",
                                   center, size));
}

std::optional<FieldProblem> inside(const std::string& part, std::optional<FieldProblem> found) {
  if (found) found->field = part + "." + found->field;
  return found;
}

// How the mannequin is looked at from a pose (world from sensor): by how much the optical axis misses the vertical
// through the origin, metres; infinite where it is behind.
double missed_m(const Isometry3d& pose) {
  const Eigen::Vector2d at(pose.translation().x(), pose.translation().z());
  Eigen::Vector2d axis(pose.linear()(0, 2), pose.linear()(2, 2));
  if (at.norm() < 0.3) return 0;  // above the mannequin
  if (axis.norm() < 0.3 || axis.dot(-at) <= 0) return std::numeric_limits<double>::infinity();
  axis.normalize();
  return std::abs(at.x() * axis.y() - at.y() * axis.x());
}

bool in_room(const Isometry3d& pose) {
  return pose.translation().norm() <= kMostDistance_m && pose.translation().y() >= kLeastHeight_m &&
         pose.translation().y() <= kMostHeight_m;
}

// Part of the poses that stand in the room and look at the mannequin.
double looking(const std::vector<Isometry3d>& poses) {
  const auto good = [](const Isometry3d& pose) { return in_room(pose) && missed_m(pose) < kMissed_m; };
  return static_cast<double>(std::count_if(poses.begin(), poses.end(), good)) / static_cast<double>(poses.size());
}

struct Reading {
  const char* cause;
  Isometry3d (*of)(const Isometry3d&);
};

Isometry3d turned(const Isometry3d& pose, const Eigen::Matrix3d& world, const Eigen::Matrix3d& sensor) {
  Isometry3d result = pose;
  result.linear() = world * pose.linear() * sensor;
  result.translation() = world * pose.translation();
  return result;
}

Isometry3d transposed_rotation(const Isometry3d& pose) {
  Isometry3d result = pose;
  result.linear() = pose.linear().transpose().eval();
  return result;
}

Eigen::Matrix3d from_z_up() { return (Eigen::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished(); }

// Other ways to write the same rig, as they come from other tools.
const std::array<Reading, 5>& readings() {
  static const std::array<Reading, 5> all{{
      {"looks like sensor from world, the inverse; write world from sensor",
       [](const Isometry3d& pose) { return Isometry3d(pose.inverse()); }},
      {"looks like rotations that are transposed; write them row by row", transposed_rotation},
      {"looks like cameras with y up and z backwards (OpenGL's); turn them to y down and z forward",
       [](const Isometry3d& pose) {
         return turned(pose, Eigen::Matrix3d::Identity(), Vector3d(1, -1, -1).asDiagonal());
       }},
      {"looks like a world with z up; turn it to y up",
       [](const Isometry3d& pose) { return turned(pose, from_z_up(), Eigen::Matrix3d::Identity()); }},
      {"looks like a world with y down; turn it to y up",
       [](const Isometry3d& pose) {
         return turned(pose, Vector3d(1, -1, -1).asDiagonal(), Eigen::Matrix3d::Identity());
       }},
  }};
  return all;
}

std::optional<FieldProblem> misread_prior(const RigPrior& prior) {
  std::vector<Isometry3d> poses;
  for (const auto& [sensor, pose] : prior.world_from_sensor) poses.push_back(pose);
  const double given = looking(poses);
  if (poses.size() < 2 || given > 0.5) return {};
  for (const Reading& reading : readings()) {
    std::vector<Isometry3d> read;
    for (const auto& pose : poses) read.push_back(reading.of(pose));
    if (looking(read) < 1) continue;
    return problem("",
                   fmt::format("found {} of {} sensors that look at the mannequin near the origin; expected poses "
                               "of a rig round it, metres, world from sensor, y up ({})",
                               std::lround(given * static_cast<double>(poses.size())), poses.size(), reading.cause));
  }
  return {};
}

std::optional<FieldProblem> misplaced(const std::string& sensor, const Isometry3d& pose) {
  const Vector3d at = pose.translation();
  const std::string place = fmt::format("found a sensor at ({:g}, {:g}, {:g}) m", at.x(), at.y(), at.z());
  if (at.norm() > kMostDistance_m)
    return problem(sensor, fmt::format("{}; expected metres, at most {:g} m from the mannequin near the origin{}",
                                       place, kMostDistance_m, unit_guess(at.norm(), 1.2, 6)));
  if (at.y() < kLeastHeight_m || at.y() > kMostHeight_m)
    return problem(sensor, fmt::format("{}; expected one above the floor y = 0 and under a ceiling, y = {:g} to {:g} m",
                                       place, 0.0, kMostHeight_m));
  return {};
}

}  // namespace

std::string unit_guess(double found, double usual_least_m, double usual_most_m) {
  for (const char* name : {"mm", "cm", "inch", "dm"}) {  // what people measure in comes first
    const LengthUnit& unit = length_unit(name);
    const double meant_m = found * unit.metres;
    if (meant_m >= usual_least_m && meant_m <= usual_most_m)
      return fmt::format(" (looks like {}: {:.4g} m would be usual)", unit.plural, meant_m);
  }
  return {};
}

std::optional<FieldProblem> problem_with(const Camera& camera) {
  if (auto found = focal_problem("fx", camera.fx, camera.width)) return found;
  if (auto found = focal_problem("fy", camera.fy, camera.width)) return found;
  if (camera.fx > kMostAspect * camera.fy || camera.fy > kMostAspect * camera.fx)
    return problem(
        "fy", fmt::format("found {:g} px where fx is {:g} px; expected nearly square pixels", camera.fy, camera.fx));
  if (auto found = center_problem("cx", camera.cx, camera.width)) return found;
  if (auto found = center_problem("cy", camera.cy, camera.height)) return found;
  for (const double k : camera.distortion)
    if (!(std::abs(k) <= kMostDistortion))
      return problem("distortion", fmt::format("found a coefficient of {:g}; expected [k1, k2, p1, p2, k3] of the "
                                               "camera at focal length 1, {:g} at most",
                                               k, kMostDistortion));
  return {};
}

std::optional<FieldProblem> problem_with(const SensorCalibration& sensor) {
  if (auto found = inside("ir", problem_with(sensor.ir))) return found;
  if (sensor.color)
    if (auto found = inside("color", problem_with(*sensor.color))) return found;
  const double step_m = sensor.color_from_ir.translation().norm();
  if (sensor.color && !(step_m <= kMostStep_m))
    return problem("color_from_ir", fmt::format("found a step of {:g} m; expected metres, {:g} m at most between the "
                                                "two cameras of one sensor{}",
                                                step_m, kMostStep_m, unit_guess(step_m, 0.01, 0.12)));
  if (!(std::abs(sensor.depth_offset_m) <= kMostOffset_m))
    return problem("depth_offset_m", fmt::format("found {:g} m; expected metres, {:g} m at most (measured less true "
                                                 "depth){}",
                                                 sensor.depth_offset_m, kMostOffset_m,
                                                 unit_guess(std::abs(sensor.depth_offset_m), 0.001, 0.05)));
  return {};
}

std::string problem_with_board(int inner_corners_x, int inner_corners_y, double square_m) {
  const double longest_m = square_m * (std::max(inner_corners_x, inner_corners_y) + 1);
  if (square_m >= kLeastSquare_m && square_m <= kMostSquare_m && longest_m <= kMostBoard_m) return {};
  return fmt::format(
      "found squares of {:g} m, so a board {:g} m long; expected the side of one square in metres, {:g} to {:g} m, of "
      "a "
      "board of at most {:g} m{}",
      square_m, longest_m, kLeastSquare_m, kMostSquare_m, kMostBoard_m,
      square_m > kLeastSquare_m ? unit_guess(square_m, 0.015, 0.12) : "");
}

std::optional<FieldProblem> problem_with_prior(const RigPrior& prior) {
  if (auto found = misread_prior(prior)) return found;
  for (const auto& [sensor, pose] : prior.world_from_sensor)
    if (auto found = misplaced(sensor, pose)) return found;
  if (!(prior.translation_sigma_m <= kMostSigma_m))
    return problem(
        "", fmt::format("found a sigma of {:g} m (prior_sigma.translation_m); expected metres, at most {:g} "
                        "m: leave the prior out where nothing is known{}",
                        prior.translation_sigma_m, kMostSigma_m, unit_guess(prior.translation_sigma_m, 0.01, 1)));
  return {};
}

}  // namespace dressform
