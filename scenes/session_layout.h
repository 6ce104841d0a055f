#pragma once
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace dressform {

// File names of the capture session on disk, version 1 (scenes/README.md).
namespace session_layout {

inline const char* const kFormat = "dressform-session";
inline const char* const kCalibrationFormat = "dressform-calibration";
inline const char* const kPosesFormat = "dressform-scan-poses";
inline const char* const kPoses = "poses.json";  // in a scan's folder
inline constexpr int kVersion = 1;
inline constexpr int kMostFrames = 10000;  // of a scan, and board shots of a sensor: what four digits number
inline const std::vector<std::string> kScans{"scan_naked", "scan_user"};

inline std::string depth_frame(int index) {
  char name[32];
  std::snprintf(name, sizeof name, "%04d_depth.png", index);
  return name;
}

inline std::string board_image(int index, const char* what) {
  char name[48];
  std::snprintf(name, sizeof name, "%02d_%s.png", index, what);
  return name;
}

}  // namespace session_layout
}  // namespace dressform
