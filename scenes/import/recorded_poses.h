#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

// Poses of a recording's camera over time, world from camera.
struct StampedPose {
  double stamp_s = 0;
  Isometry3d world_from_camera = Isometry3d::Identity();
};

// Lines of "stamp x y z qx qy qz qw", `#` for comments (the RGB-D benchmark's groundtruth.txt, and evo's "TUM" format).
// Throws InputError naming the line that is no such thing, whose quaternion is not of length one (to 1 %), or whose
// stamp does not increase.
std::vector<StampedPose> stamped_poses(const std::filesystem::path& file);

// The pose at a time: between the two next to it, when they are at most `longest_gap_s` apart. Nothing elsewhere.
std::optional<Isometry3d> pose_at(const std::vector<StampedPose>& poses, double stamp_s, double longest_gap_s);

// Blocks of three whole numbers, of which the first is the frame's, and four rows of a matrix (Redwood's and Open3D's
// .log files). By frame, from 0; nothing for frames without a block. Throws InputError naming the line.
std::vector<std::optional<Isometry3d>> logged_poses(const std::filesystem::path& file);

// A rotation, rounded to 1e-3 at most, and a translation. Throws InputError at `where` for anything else.
Isometry3d rigid_motion(const std::string& where, const Eigen::Matrix3d& rotation, const Vector3d& translation_m);

}  // namespace dressform
