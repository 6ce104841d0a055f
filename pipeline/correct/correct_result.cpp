#include "pipeline/correct/correct_result.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "pipeline/geometry/intersections.h"
#include "scenes/error.h"

namespace dressform {

void add_corrected(const std::string& name, const TexturedMesh& before, std::vector<Vector3d> vertices,
                   int intersecting_pairs, CorrectedGarments& result) {
  int moved = 0;
  double largest = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double move = (vertices[v] - before.mesh.vertices[v]).norm();
    moved += move > 0;
    largest = std::max(largest, move);
  }
  TexturedMesh after = before;
  after.texture = before.texture.clone();
  after.mesh.vertices = std::move(vertices);
  result.garments[name] = std::move(after);
  result.moved_vertices[name] = moved;
  result.largest_move_m[name] = largest;
  result.intersecting_pairs[name] = intersecting_pairs;
  result.converged[name] = intersecting_pairs == 0;
}

CorrectedGarments each_vertex_moved(const KnownBody& user, const FittedGarments& fitted,
                                    const std::function<Vector3d(const Vector3d&)>& target) {
  CorrectedGarments result;
  for (const auto& [name, garment] : fitted.garments) {
    Mesh moved = garment.mesh;
    tbb::parallel_for(std::size_t{0}, moved.vertices.size(),
                      [&](std::size_t v) { moved.vertices[v] = target(garment.mesh.vertices[v]); });
    const auto pairs = static_cast<int>(intersecting_pairs(moved, user.body).size());
    add_corrected(name, garment, std::move(moved.vertices), pairs, result);
  }
  return result;
}

void require_user(const KnownBody& user, const std::string& variant) { require_known(user, variant + ": user's body"); }

}  // namespace dressform
