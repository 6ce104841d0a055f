// As-rigid-as-possible deformation: Sorkine and Alexa, SGP 2007. The naked body takes the user's shape, held at the
// pairs that the program finds on both; then the clothes follow, held at vertices spread over them, each moved as the
// place of the body next to it. Between those cloth turns but stretches as little as may be.
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "pipeline/fit/body_warp.h"
#include "pipeline/fit/fit.h"
#include "pipeline/fit/fit_result.h"
#include "pipeline/geometry/rigid_as_possible.h"
#include "scenes/error.h"

namespace dressform {
namespace {

struct ArapParams {
  int rounds = 10;
  double hold_spacing_m = 0.08;
};
template <class V>
void fields(V& v, ArapParams& p) {
  v("rounds", p.rounds, 1, 500, "", "of turning neighbourhoods and solving for places");
  v("hold_spacing_m", p.hold_spacing_m, 0.01, 0.5, "m", "between vertices of cloth that follow the body");
}

// Vertices of a mesh and where they go.
struct Holds {
  std::vector<int> vertices;
  std::vector<Vector3d> places;
};

// The body's vertex nearest to each pair's control, moved as the control is; the first pair of a vertex counts.
Holds body_holds(const Mesh& body, const MeshQuery& surface, const std::vector<ControlPair>& pairs) {
  std::map<int, Vector3d> places;
  for (const ControlPair& pair : pairs) {
    const auto closest = surface.closest(pair.control);
    if (closest.triangle < 0) continue;
    const Vector3i& t = body.triangles[closest.triangle];
    const auto away = [&](int v) { return (body.vertices[v] - closest.point).squaredNorm(); };
    int nearest = t[0];
    for (const int k : {1, 2})
      if (away(t[k]) < away(nearest)) nearest = t[k];
    places.emplace(nearest, body.vertices[nearest] + pair.target - pair.control);
  }
  Holds holds;
  for (const auto& [vertex, place] : places) {
    holds.vertices.push_back(vertex);
    holds.places.push_back(place);
  }
  return holds;
}

// The displacement of the deformed body at a point of the body's surface.
Vector3d displacement_at(const Mesh& body, const Mesh& deformed, const MeshQuery::Closest& at) {
  const Vector3i& t = body.triangles[at.triangle];
  const Vector3d &a = body.vertices[t[0]], &b = body.vertices[t[1]], &c = body.vertices[t[2]];
  const Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (area <= 0) return deformed.vertices[t[0]] - a;
  const double wa = normal.dot((b - at.point).cross(c - at.point)) / area;
  const double wb = normal.dot((c - at.point).cross(a - at.point)) / area;
  return wa * (deformed.vertices[t[0]] - a) + wb * (deformed.vertices[t[1]] - b) +
         (1 - wa - wb) * (deformed.vertices[t[2]] - c);
}

// One vertex of the cloth in each cell, the first in the mesh's order, moved as the body next to it.
Holds cloth_holds(const Mesh& garment, const Mesh& body, const MeshQuery& surface, const Mesh& deformed,
                  double spacing_m) {
  std::map<std::tuple<long, long, long>, int> cells;
  for (std::size_t v = 0; v < garment.vertices.size(); ++v) {
    const Vector3d cell = (garment.vertices[v] / spacing_m).array().floor();
    cells.emplace(std::make_tuple(std::lround(cell.x()), std::lround(cell.y()), std::lround(cell.z())),
                  static_cast<int>(v));
  }
  Holds holds;
  for (const auto& [cell, v] : cells) {
    const auto closest = surface.closest(garment.vertices[v]);
    holds.vertices.push_back(v);
    holds.places.push_back(garment.vertices[v] + displacement_at(body, deformed, closest));
  }
  return holds;
}

// Throws InputError where there is no answer.
Mesh deformed_by(const Mesh& mesh, const Holds& holds, int rounds, const std::string& whose) {
  if (mesh.vertices.empty()) return mesh;
  Mesh result = rigid_as_possible(mesh, holds.vertices, holds.places, rounds);
  if (result.vertices.empty())
    throw InputError("fit.arap: " + whose,
                     "found triangles without area, or a piece that nothing holds; expected a mesh with cotangents, "
                     "of pieces that reach over several of hold_spacing_m");
  return result;
}

FittedGarments arap(const KnownBody& naked_model, const KnownBody& user_model, const TexturedGarments& clothes,
                    const GarmentLayouts& layouts, const ArapParams& params) {
  require_bodies(naked_model, user_model, "fit.arap");
  const Eigen::Matrix4d motion = user_from_naked(naked_model.landmarks, user_model.landmarks);
  const StandingBody user(user_model);
  const StandingBody naked({transformed(naked_model.body, motion), transformed(naked_model.landmarks, motion)});
  const MeshQuery naked_surface(naked.mesh), user_surface(user.mesh);
  const std::vector<ControlPair> pairs = body_pairs(naked, naked_surface, user, user_surface, {});

  FittedGarments result;
  result.deformed_body =
      deformed_by(naked.mesh, body_holds(naked.mesh, naked_surface, pairs), params.rounds, "naked body");
  for (const auto& [name, garment] : clothes.garments) {
    const Mesh turned = transformed(garment.mesh, motion);
    const Holds holds = cloth_holds(turned, naked.mesh, naked_surface, result.deformed_body, params.hold_spacing_m);
    const Mesh fitted = deformed_by(turned, holds, params.rounds, "garment \"" + name + "\"");
    result.foldovers += count_foldovers(turned, fitted);
    add_fitted(name, garment, fitted.vertices, layout_of(name, layouts, "fit.arap"), user_model, user_surface, result);
  }
  result.body_rms_m = rms_distance(result.deformed_body, user_surface);
  result.control_points = static_cast<int>(pairs.size());
  return result;
}

const Fit::Variant arap_variant{"arap", arap};

}  // namespace
}  // namespace dressform
