#pragma once
#include <cstdint>
#include <nanoflann.hpp>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Points as nanoflann reads them.
struct TreePoints {
  const std::vector<Vector3d>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

// Nearest points of a list, by a k-d tree (Bentley, 1975). Looks at the caller's points, which must outlive it and stay
// as they are. Distances are in the points' unit, squared. Safe to ask from several threads.
class PointTree {
 public:
  explicit PointTree(const std::vector<Vector3d>& points) : points_{points}, tree_(3, points_) {}
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  // The nearest point's place in the list and its squared distance. False, and nothing written, for an empty list or a
  // point that is not finite.
  bool nearest(const Vector3d& point, std::uint32_t& index, double& squared) const {
    return !points_.points.empty() && point.allFinite() && tree_.knnSearch(point.data(), 1, &index, &squared) > 0;
  }
  // The squared distances of the `count` nearest, ascending, into the list's first places: how many there are.
  std::size_t nearest_squared(const Vector3d& point, std::size_t count, std::vector<double>& squared) const {
    squared.resize(count);
    if (!point.allFinite()) return 0;
    std::vector<std::uint32_t> indices(count);
    return tree_.knnSearch(point.data(), count, indices.data(), squared.data());
  }

 private:
  TreePoints points_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, TreePoints>, TreePoints, 3> tree_;
};

}  // namespace dressform
