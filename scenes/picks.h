#pragma once
#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

constexpr const char* kPicksFolder = "picks";  // of a session

// Points that a person picked, in order, metres.
struct PickedPoints {
  // Whose coordinates: "model" (the naked body as a run made it), "user" (the user's), the name of a sensor of the rig
  // (its infrared camera's frame), or "scan_naked", "scan_user" (the infrared camera of that scan's first frame).
  std::string frame;
  std::vector<Vector3d> points;
};

// What a person picked by hand: an input of its own, for the variants that ask for it and no others.
struct Picks {
  std::map<std::string, std::vector<PickedPoints>> points;  // by name: "rim_top_neck"; one entry for each frame
  std::map<std::string, cv::Mat> regions;  // by name: "region_top_k2", uint8, 255 inside, at the size of the image

  std::vector<std::string> names() const;
};

// The picked region of this name (uint8, 255 inside), which has to be as large as the colour image it was drawn in; an
// empty one where there is none of that name. Throws InputError naming it for one of another size.
cv::Mat picked_region(const Picks& picks, const std::string& name, const cv::Size& size);

// The folder `picks` of a session: formats and names in scenes/README.md. Nothing where there is no such folder.
// Strict: throws InputError that names file and line for what can't be read, and for names and frames that mean
// nothing.
std::optional<Picks> read_picks(const std::filesystem::path& session);

// Writes the folder `picks` into a session that has none. Throws InputError where there is one.
void write_picks(const std::filesystem::path& session, const Picks& picks);

// Hash (hex) of the files of the folder `picks`, and of their names; that of nothing where there is no such folder.
std::string picks_content_hash(const std::filesystem::path& session);

}  // namespace dressform
