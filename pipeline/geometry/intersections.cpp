#include "pipeline/geometry/intersections.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace dressform {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Triangle triangle_of(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto point = [](const Vector3d& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  return Triangle(point(a), point(b), point(c));
}

}  // namespace

struct IntersectionFinder::Tree {
  std::vector<Triangle> triangles;
  std::vector<int> numbers;  // in the mesh
  CgalTree tree;
};

IntersectionFinder::IntersectionFinder(const Mesh& fixed) : tree_(std::make_unique<Tree>()) {
  for (std::size_t i = 0; i < fixed.triangles.size(); ++i) {
    const Vector3i& t = fixed.triangles[i];
    const Triangle triangle = triangle_of(fixed.vertices[t[0]], fixed.vertices[t[1]], fixed.vertices[t[2]]);
    if (triangle.is_degenerate()) continue;
    tree_->triangles.push_back(triangle);
    tree_->numbers.push_back(static_cast<int>(i));
  }
  tree_->tree.insert(tree_->triangles.cbegin(), tree_->triangles.cend());
  tree_->tree.build();
}
IntersectionFinder::~IntersectionFinder() = default;
IntersectionFinder::IntersectionFinder(IntersectionFinder&&) noexcept = default;
IntersectionFinder& IntersectionFinder::operator=(IntersectionFinder&&) noexcept = default;

std::vector<int> IntersectionFinder::cut_by(const Vector3d& a, const Vector3d& b, const Vector3d& c) const {
  const Triangle triangle = triangle_of(a, b, c);
  if (triangle.is_degenerate() || tree_->triangles.empty()) return {};
  std::vector<Primitive::Id> found;
  tree_->tree.all_intersected_primitives(triangle, std::back_inserter(found));
  std::vector<int> numbers;
  for (const auto& id : found) numbers.push_back(tree_->numbers[id - tree_->triangles.cbegin()]);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<std::pair<int, int>> intersecting_pairs(const Mesh& moving, const Mesh& fixed) {
  const IntersectionFinder finder(fixed);
  std::vector<std::vector<int>> cuts(moving.triangles.size());
  tbb::parallel_for(std::size_t{0}, cuts.size(), [&](std::size_t i) {
    const Vector3i& t = moving.triangles[i];
    cuts[i] = finder.cut_by(moving.vertices[t[0]], moving.vertices[t[1]], moving.vertices[t[2]]);
  });
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < cuts.size(); ++i)
    for (int other : cuts[i]) pairs.emplace_back(static_cast<int>(i), other);
  return pairs;
}

}  // namespace dressform
