#include "pipeline/fit/fit_result.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <utility>

#include "pipeline/garment/garment_ends.h"
#include "pipeline/garment/sleeves.h"
#include "scenes/error.h"

namespace dressform {

void require_bodies(const KnownBody& naked, const KnownBody& user, const std::string& variant) {
  for (const auto& [body, whose] : {std::pair{&naked, ": naked body"}, std::pair{&user, ": user's body"}}) {
    require_known(*body, variant + whose);
    if (!body->landmarks.has_trunk)
      throw InputError(variant + whose, "found no trunk between crotch and armpits; expected a standing body, y up");
  }
}

Eigen::Matrix4d user_from_naked(const Landmarks& naked, const Landmarks& user, double scale) {
  Eigen::Matrix3d naked_axes, user_axes;
  naked_axes << naked.left, Vector3d::UnitY(), naked.front;
  user_axes << user.left, Vector3d::UnitY(), user.front;
  Vector3d from = naked.axis, to = user.axis;
  from.y() = naked.floor_y;
  to.y() = user.floor_y;
  Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();
  motion.topLeftCorner<3, 3>() = scale * user_axes * naked_axes.transpose();
  motion.topRightCorner<3, 1>() = to - motion.topLeftCorner<3, 3>() * from;
  return motion;
}

TexturedMesh with_vertices(const TexturedMesh& garment, std::vector<Vector3d> vertices) {
  TexturedMesh result = garment;
  result.texture = garment.texture.clone();
  result.mesh.vertices = std::move(vertices);
  return result;
}

const GarmentLayout& layout_of(const std::string& garment, const GarmentLayouts& layouts, const std::string& variant) {
  const auto found = layouts.find(garment);
  if (found == layouts.end())
    throw InputError(variant, "no layout of the garment \"" + garment + "\"; expected one for every garment");
  return found->second;
}

void add_fitted(const std::string& name, const TexturedMesh& garment, std::vector<Vector3d> vertices,
                const GarmentLayout& layout, const KnownBody& user, const MeshQuery& user_surface,
                FittedGarments& result) {
  const TexturedMesh& fitted = result.garments[name] = with_vertices(garment, std::move(vertices));
  result.layouts[name] = with_sleeve_ends(with_ends(layout, fitted.mesh.vertices, user_surface, user.landmarks),
                                          fitted.mesh, user.landmarks);
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
