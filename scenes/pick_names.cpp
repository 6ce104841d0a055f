#include "scenes/pick_names.h"

#include <algorithm>

namespace dressform {
namespace {

const std::vector<std::string> kFrames{kModelFrame, kUserFrame, kNakedScanFrame, kUserScanFrame};
const std::vector<std::string> kGarments{"top", "bottom"};
const std::vector<std::string> kRims{"neck", "left_cuff", "right_cuff", "hem", "waist", "left_ankle", "right_ankle"};
const std::vector<std::string> kRegionKinds{"label_skin",    "label_top",     "label_bottom",
                                            "region_top",    "region_bottom", "smooth_top",
                                            "smooth_bottom", "outliers_top",  "outliers_bottom"};
const char* const kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_";

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string words(const std::vector<std::string>& list) {
  std::string text;
  for (const auto& word : list) text += (text.empty() ? "" : ", ") + word;
  return text;
}

bool starts_with(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

// What follows "<kind>_<garment>_" in a name; nothing where it does not begin like this.
std::optional<std::string> after_garment(const std::string& name, const std::string& kind) {
  for (const auto& garment : kGarments) {
    const std::string start = kind + "_" + garment + "_";
    if (starts_with(name, start) && name.size() > start.size()) return name.substr(start.size());
  }
  return {};
}

}  // namespace

bool is_sensor_frame(const std::string& frame) { return !contains(kFrames, frame); }

bool is_users_frame(const std::string& frame) { return frame == kUserFrame || frame == kUserScanFrame; }

bool is_closed_path(const std::string& name) { return starts_with(name, "rim_"); }

bool is_open_path(const std::string& name) { return starts_with(name, "border_"); }

std::string problem_with_points_name(const std::string& name) {
  if (name == "control" || name == "target") return {};
  const auto rim = after_garment(name, "rim");
  if (rim && contains(kRims, *rim)) return {};
  const auto border = after_garment(name, "border");
  if (border && border->find_first_not_of(kLetters) == border->npos) return {};
  return "found points named \"" + name + "\"; expected rim_<top|bottom>_<rim> with a rim of " + words(kRims) +
         ", border_<top|bottom>_<where>, control or target";
}

std::string problem_with_points_frame(const std::string& name, const std::string& frame) {
  if (is_users_frame(frame) == (name == "target")) return {};
  return "found \"" + name + "\" in the frame \"" + frame + "\"; expected " +
         (name == "target"
              ? "points of the user in picks/user or picks/scan_user"
              : "points of the mannequin in picks/model, picks/scan_naked or a folder named like a sensor");
}

int least_points(const std::string& name) { return is_closed_path(name) ? 3 : is_open_path(name) ? 2 : 4; }

std::optional<RegionName> region_name(const std::string& name, const std::vector<std::string>& sensors) {
  for (const auto& kind : kRegionKinds)
    if (starts_with(name, kind + "_") && contains(sensors, name.substr(kind.size() + 1)))
      return RegionName{kind, name.substr(kind.size() + 1)};
  return {};
}

bool is_region_kind(const std::string& kind) { return contains(kRegionKinds, kind); }

std::string known_region_kinds() { return words(kRegionKinds); }

}  // namespace dressform
