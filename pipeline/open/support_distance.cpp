#include "pipeline/open/support_distance.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "pipeline/geometry/point_tree.h"

namespace dressform {
std::vector<double> support_distances(const std::vector<Vector3d>& queries, const std::vector<Vector3d>& support,
                                      int rank) {
  std::vector<double> distances(queries.size(), std::numeric_limits<double>::infinity());
  const auto wanted = static_cast<std::size_t>(rank);
  if (support.size() < wanted || wanted == 0) return distances;
  const PointTree tree(support);
  tbb::parallel_for(std::size_t{0}, queries.size(), [&](std::size_t i) {
    std::vector<double> squared;
    if (tree.nearest_squared(queries[i], wanted, squared) == wanted) distances[i] = std::sqrt(squared.back());
  });
  return distances;
}

}  // namespace dressform
