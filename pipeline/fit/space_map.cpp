#include "pipeline/fit/space_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace dressform {

std::vector<Vector3d> SpaceMap::operator()(const std::vector<Vector3d>& points) const {
  constexpr std::size_t kPointsATask = 256;
  std::vector<Vector3d> moved(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kPointsATask), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) moved[i] = (*this)(points[i]);
  });
  return moved;
}

}  // namespace dressform
