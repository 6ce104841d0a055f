#pragma once
#include <vector>

#include "pipeline/open/cut.h"
#include "pipeline/open/open_scene.h"
#include "pipeline/open/openings.h"
#include "pipeline/open/rim_fit.h"

namespace dressform {

// Beyond a cuff, only what is nearer to the arm comes off, also where the sleeve touches the trunk.
// Per vertex of the closed mesh, half of how much nearer it is to the arm than to the rest; infinite for openings of
// other limbs.
std::vector<double> limit_of(const Opening& opening, const Mesh& mesh, const OpenScene& scene);

// Beyond a hem, nothing that is nearest to what the sleeves cover of the arms: where a sleeve touches the trunk it
// would come off with what the hem closes, because it hangs as low.
std::vector<double> limit_of_hem(const std::vector<Opening>& openings, const std::vector<RimCurve>& curves,
                                 const Mesh& mesh, const OpenScene& scene);

// The pole, a vertex in the middle of what lies beyond the rim: the farthest along among those over the right part of
// the body; of an arm, not where it touches the trunk.
Cap make_cap(const Opening& opening, const RimCurve& curve, const Mesh& mesh, const std::vector<BodyPart>& parts,
             const std::vector<double>& limit, const Landmarks& landmarks);

}  // namespace dressform
