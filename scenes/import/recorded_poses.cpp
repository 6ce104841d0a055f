#include "scenes/import/recorded_poses.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "scenes/error.h"
#include "scenes/session_layout.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kRoundedRotation = 1e-3;    // recorders write four digits or more
constexpr double kRoundedQuaternion = 0.01;  // of its length: the benchmark writes four digits

// The lines of a text file that say something, with their numbers.
struct NumberedLine {
  int number = 0;
  std::string text;
};
std::vector<NumberedLine> lines_of(const fs::path& file) {
  std::ifstream in(file);
  if (!in || fs::is_directory(file)) throw InputError(file.string(), "can't be read; expected poses");
  std::vector<NumberedLine> lines;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first != line.npos && line[first] != '#') lines.push_back({number, line});
  }
  return lines;
}

std::string place(const fs::path& file, const NumberedLine& line) {
  return file.string() + ":" + std::to_string(line.number);
}

template <std::size_t Count>
std::array<double, Count> numbers_in(const fs::path& file, const NumberedLine& line, const char* what) {
  std::array<double, Count> numbers;
  std::istringstream words(line.text);
  std::string word, rest;
  for (double& number : numbers) {
    char* end = nullptr;
    number = words >> word ? std::strtod(word.c_str(), &end) : std::nan("");
    if (!std::isfinite(number) || !end || *end != '\0')
      throw InputError(place(file, line), "found \"" + line.text + "\"; expected " + what);
  }
  if (words >> rest) throw InputError(place(file, line), "found \"" + line.text + "\"; expected " + what);
  return numbers;
}

}  // namespace

Isometry3d rigid_motion(const std::string& where, const Eigen::Matrix3d& rotation, const Vector3d& translation_m) {
  const double off = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kRoundedRotation) || rotation.determinant() < 0 || !translation_m.allFinite())
    throw InputError(where, fmt::format("found a matrix that is no rotation (R times its transpose is off the identity "
                                        "by {:.3g}); expected the pose of a camera",
                                        off));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Isometry3d result = Isometry3d::Identity();
  result.linear() = svd.matrixU() * svd.matrixV().transpose();
  result.translation() = translation_m;
  return result;
}

std::vector<StampedPose> stamped_poses(const fs::path& file) {
  std::vector<StampedPose> poses;
  for (const NumberedLine& line : lines_of(file)) {
    const auto n = numbers_in<8>(file, line, "a stamp, x y z (metres) and a quaternion qx qy qz qw");
    const Eigen::Quaterniond turn(n[7], n[4], n[5], n[6]);
    if (std::abs(turn.norm() - 1) > kRoundedQuaternion)
      throw InputError(place(file, line),
                       fmt::format("found a quaternion of length {:.3g}; expected one of length 1", turn.norm()));
    if (!poses.empty() && n[0] <= poses.back().stamp_s)
      throw InputError(place(file, line), fmt::format("found stamp {:.6f} after {:.6f}; expected stamps that increase",
                                                      n[0], poses.back().stamp_s));
    StampedPose pose;
    pose.stamp_s = n[0];
    pose.world_from_camera.linear() = turn.normalized().toRotationMatrix();
    pose.world_from_camera.translation() = Vector3d(n[1], n[2], n[3]);
    poses.push_back(pose);
  }
  return poses;
}

std::optional<Isometry3d> pose_at(const std::vector<StampedPose>& poses, double stamp_s, double longest_gap_s) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), stamp_s,
                                      [](const StampedPose& pose, double stamp) { return pose.stamp_s < stamp; });
  if (after == poses.end()) return {};
  if (after->stamp_s == stamp_s) return after->world_from_camera;
  if (after == poses.begin()) return {};
  const auto before = after - 1;
  const double gap_s = after->stamp_s - before->stamp_s, part = (stamp_s - before->stamp_s) / gap_s;
  if (gap_s > longest_gap_s) return {};
  const Isometry3d &a = before->world_from_camera, &b = after->world_from_camera;
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() =
      Eigen::Quaterniond(a.linear()).slerp(part, Eigen::Quaterniond(b.linear())).normalized().toRotationMatrix();
  pose.translation() = (1 - part) * a.translation() + part * b.translation();
  return pose;
}

std::vector<std::optional<Isometry3d>> logged_poses(const fs::path& file) {
  std::vector<std::optional<Isometry3d>> poses;
  const auto lines = lines_of(file);
  for (std::size_t i = 0; i < lines.size(); i += 5) {
    const auto head = numbers_in<3>(file, lines[i], "three whole numbers, of which the first is the frame's");
    if (head[0] < 0 || head[0] >= session_layout::kMostFrames || head[0] != std::floor(head[0]))
      throw InputError(place(file, lines[i]), fmt::format("found frame {:g}; expected a whole number from 0 to {}",
                                                          head[0], session_layout::kMostFrames - 1));
    if (i + 4 >= lines.size())
      throw InputError(place(file, lines.back()), "found no more lines; expected four rows of a matrix in each block");
    Eigen::Matrix4d matrix;
    for (int row = 0; row < 4; ++row)
      matrix.row(row) =
          Eigen::RowVector4d::Map(numbers_in<4>(file, lines[i + 1 + row], "a row of four numbers").data());
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
      throw InputError(place(file, lines[i + 4]), "found \"" + lines[i + 4].text + "\"; expected 0 0 0 1");
    const auto frame = static_cast<std::size_t>(head[0]);
    if (poses.size() <= frame) poses.resize(frame + 1);
    poses[frame] = rigid_motion(place(file, lines[i + 1]), matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>());
  }
  return poses;
}

}  // namespace dressform
