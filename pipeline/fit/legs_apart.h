#pragma once
#include <vector>

#include "pipeline/fit/standing_body.h"

namespace dressform {

// The leg of the wearer that each vertex of the garment goes round: 0 left, 1 right, -1 neither. Told by the garment's
// own shape, below the height where it parts into two: cloth between thighs lies as near to one as to the other.
// Nothing but -1 for what does not part (shirts, skirts).
std::vector<int> leg_of_vertices(const Mesh& garment, const StandingBody& wearer);

// The fitted garment's vertices with those of either leg kept on its side of the surface midway between the user's
// legs, `gap_m` off it: thighs that touch press the cloth between them flat, and the two legs of trousers never pass
// through one another. `leg`: per vertex, as above. Cloth that is on its own side stays.
std::vector<Vector3d> legs_kept_apart(const Mesh& fitted, const std::vector<int>& leg, const StandingBody& user,
                                      double gap_m);

}  // namespace dressform
