#include "scenes/scan_poses.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <limits>
#include <string>

#include "scenes/json_file.h"
#include "scenes/session_layout.h"

namespace dressform {
namespace {

std::string frame_name(std::size_t index) {
  char name[32];
  std::snprintf(name, sizeof name, "%04zu", index);
  return name;
}

}  // namespace

Isometry3d no_pose() {
  Isometry3d pose = Isometry3d::Identity();
  pose.matrix().setConstant(std::numeric_limits<double>::quiet_NaN());
  return pose;
}

std::vector<Isometry3d> read_scan_poses(const std::filesystem::path& file, std::size_t frames) {
  const JsonValue poses =
      read_json(file, session_layout::kPosesFormat, session_layout::kVersion).at("world_from_frame");
  std::vector<Isometry3d> result(frames, no_pose());
  for (const auto& name : poses.names()) {
    const bool digits =
        name.size() == 4 && std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); });
    const std::size_t index = digits ? std::stoul(name) : frames;
    if (index >= frames)
      poses.fail("found frame \"" + name + "\"; expected \"0000\" to \"" + frame_name(frames - 1) + "\"");
    result[index] = poses.at(name).rigid();
  }
  return result;
}

void write_scan_poses(const std::filesystem::path& file, const std::vector<Isometry3d>& world_from_frame) {
  auto poses = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < world_from_frame.size(); ++i)
    if (world_from_frame[i].matrix().allFinite()) poses[frame_name(i)] = to_json(world_from_frame[i]);
  write_json(
      file,
      {{"format", session_layout::kPosesFormat}, {"version", session_layout::kVersion}, {"world_from_frame", poses}});
}

}  // namespace dressform
