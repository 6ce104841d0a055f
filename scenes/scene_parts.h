#pragma once
#include "scenes/scene.h"

namespace dressform {

// The scene with another rig or scan, read from a file of its own as a scene names it (`rig = "rigs/thesis.toml"`); its
// text says so. Throws InputError with file, line and column.
Scene with_rig(const Scene& scene, const std::filesystem::path& file);
Scene with_scan(const Scene& scene, const std::filesystem::path& file);

// Names of the files that such a part is made of: its own first, then those that it refers to, as it does.
std::vector<std::string> files_of_rig(const std::filesystem::path& file);
std::vector<std::string> files_of_scan(const std::filesystem::path& file);

}  // namespace dressform
