#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/reconstruct.h"

namespace dressform {

// Writes what the pipeline made for its users, into `out` (made when missing): registration.json, calibration.json,
// garments.json, naked_body.ply, user_body.ply, and for each garment <slot>_points.ply, <slot>_closed.ply, <slot>.ply
// .glb .png and <slot>_fitted.ply .glb. Same values, same bytes. Returns the file names, sorted.
std::vector<std::string> export_reconstruction(const Reconstruction& reconstruction, const std::filesystem::path& out);

}  // namespace dressform
