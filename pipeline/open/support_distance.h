#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Distance (m) of every query point from the `rank`th nearest of the points it is supported by: 1 the nearest. Infinity
// where there are fewer.
std::vector<double> support_distances(const std::vector<Vector3d>& queries, const std::vector<Vector3d>& support,
                                      int rank);

}  // namespace dressform
