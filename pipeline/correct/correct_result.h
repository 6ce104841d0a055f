#pragma once
#include <string>
#include <vector>

#include "pipeline/correct/correct.h"

namespace dressform {

// Puts a garment with its new vertices into the result, with how many moved and how far.
void add_corrected(const std::string& name, const TexturedMesh& before, std::vector<Vector3d> vertices,
                   int intersecting_pairs, CorrectedGarments& result);

// Throws InputError naming the variant when the user's body is missing.
void require_user(const BodyModel& user, const std::string& variant);

}  // namespace dressform
