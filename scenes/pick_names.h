#pragma once
#include <optional>
#include <string>
#include <vector>

namespace dressform {

// What the names of picks mean; scenes/README.md, "Picks", has them all.

// Names of frames that are no sensor's.
constexpr const char* kModelFrame = "model";
constexpr const char* kUserFrame = "user";
constexpr const char* kNakedScanFrame = "scan_naked";
constexpr const char* kUserScanFrame = "scan_user";

bool is_sensor_frame(const std::string& frame);

// Whether the points are the user's: given in the frame "user" or "scan_user".
bool is_users_frame(const std::string& frame);

// A line of points that closes ("rim_..."), one with two ends ("border_..."), or points by themselves.
bool is_closed_path(const std::string& name);
bool is_open_path(const std::string& name);

// What is wrong with points of that name in that frame, as InputError takes it; empty: nothing.
std::string problem_with_points_name(const std::string& name);
std::string problem_with_points_frame(const std::string& name, const std::string& frame);

// Least number of points that are worth the name.
int least_points(const std::string& name);

// "region_top_k2" is a region "region_top" in the colour image of the sensor "k2".
struct RegionName {
  std::string kind, sensor;
  std::string text() const { return kind + "_" + sensor; }
};
std::optional<RegionName> region_name(const std::string& name, const std::vector<std::string>& sensors);
bool is_region_kind(const std::string& kind);
std::string known_region_kinds();

}  // namespace dressform
