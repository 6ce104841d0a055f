#include "pipeline/fit/fit_result.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "scenes/error.h"

namespace dressform {

void require_bodies(const BodyModel& naked, const BodyModel& user, const std::string& variant) {
  if (naked.body.triangles.empty()) throw InputError(variant, "the naked model has no surface; expected a closed body");
  if (user.body.triangles.empty()) throw InputError(variant, "the user's model has no surface; expected a closed body");
}

TexturedMesh with_vertices(const TexturedMesh& garment, std::vector<Vector3d> vertices) {
  TexturedMesh result = garment;
  result.texture = garment.texture.clone();
  result.mesh.vertices = std::move(vertices);
  return result;
}

int count_foldovers(const Mesh& before, const Mesh& after) {
  int count = 0;
  for (const auto& t : before.triangles) {
    const auto normal = [&](const Mesh& mesh) -> Vector3d {
      return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    };
    count += normal(before).dot(normal(after)) < 0;
  }
  return count;
}

double rms_distance(const Mesh& body, const MeshQuery& surface) {
  std::vector<double> squares(body.vertices.size());
  tbb::parallel_for(std::size_t{0}, squares.size(), [&](std::size_t v) {
    const double distance = surface.closest(body.vertices[v]).distance;
    squares[v] = distance * distance;
  });
  double sum = 0;
  for (double square : squares) sum += square;
  return squares.empty() ? 0 : std::sqrt(sum / static_cast<double>(squares.size()));
}

}  // namespace dressform
