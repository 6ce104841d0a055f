#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Which triangles of a fixed mesh are cut by others: exact predicates (CGAL), so that "none" is a proof. Touching
// counts as cutting. Triangles without area are left out. Safe to ask from several threads.
class IntersectionFinder {
 public:
  explicit IntersectionFinder(const Mesh& fixed);
  ~IntersectionFinder();
  IntersectionFinder(IntersectionFinder&&) noexcept;
  IntersectionFinder& operator=(IntersectionFinder&&) noexcept;

  // Triangles of the fixed mesh that meet the triangle (a, b, c), in ascending order.
  std::vector<int> cut_by(const Vector3d& a, const Vector3d& b, const Vector3d& c) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

// All pairs (triangle of `moving`, triangle of `fixed`) that meet, in order; on all threads.
std::vector<std::pair<int, int>> intersecting_pairs(const Mesh& moving, const Mesh& fixed);

}  // namespace dressform
