#pragma once
#include <functional>
#include <string>
#include <vector>

#include "pipeline/correct/correct.h"

namespace dressform {

// Puts a garment with its new vertices into the result, with how many moved and how far.
void add_corrected(const std::string& name, const TexturedMesh& before, std::vector<Vector3d> vertices,
                   int intersecting_pairs, CorrectedGarments& result);

// Every vertex of every garment goes where `target` says, each for itself; pairs that still intersect the user's body
// are counted by exact predicates.
CorrectedGarments each_vertex_moved(const KnownBody& user, const FittedGarments& fitted,
                                    const std::function<Vector3d(const Vector3d&)>& target);

// Throws InputError naming the variant when the user's body or its landmarks are missing.
void require_user(const KnownBody& user, const std::string& variant);

}  // namespace dressform
