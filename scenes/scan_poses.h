#pragma once
#include <filesystem>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

// What was recorded of the poses of a scan's frames: poses.json in the scan's folder. World: the recorder's own, any
// gravity and heading; metres. A frame without a pose has a matrix of NaNs.

// Throws InputError naming file and field where a matrix is no rigid motion, or a frame is named that is not there.
std::vector<Isometry3d> read_scan_poses(const std::filesystem::path& file, std::size_t frames);
void write_scan_poses(const std::filesystem::path& file, const std::vector<Isometry3d>& world_from_frame);

// A pose that is not known.
Isometry3d no_pose();

}  // namespace dressform
