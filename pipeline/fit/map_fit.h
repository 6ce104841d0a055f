#pragma once
#include <string>

#include "pipeline/fit/fit.h"
#include "pipeline/fit/space_map.h"

namespace dressform {

// Makes a map from the naked body's space, turned to stand as the user does, to the user's: controls on the body and
// where they go.
using MakeBodyMap = std::function<SpaceMap(const Mesh& naked, const std::vector<Vector3d>& controls,
                                           const std::vector<Vector3d>& targets)>;

// The fit by a map of space alone, which moves body and clothes alike: the pairs that the program finds on both bodies
// (body_warp.h), one map through all of them, one through all but the arms'. `variant` names it for errors; throws as
// the stage does.
FittedGarments fitted_by_map(const KnownBody& naked, const KnownBody& user, const TexturedGarments& clothes,
                             const GarmentLayouts& layouts, const std::string& variant, const MakeBodyMap& make);

}  // namespace dressform
