#include "pipeline/open/caps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/geometry/submesh.h"

namespace dressform {
namespace {

// How much nearer each vertex is to the chosen triangles of the body than to the rest, halved.
std::vector<double> nearer_to(const std::vector<char>& chosen, const Mesh& mesh, const OpenScene& scene) {
  std::vector<char> others(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) others[i] = !chosen[i];
  const MeshQuery to_own(submesh(scene.naked.mesh(), chosen)), to_rest(submesh(scene.naked.mesh(), others));
  std::vector<double> result(mesh.vertices.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = (to_rest.closest(mesh.vertices[i]).distance - to_own.closest(mesh.vertices[i]).distance) / 2;
  return result;
}

}  // namespace

std::vector<double> limit_of(const Opening& opening, const Mesh& mesh, const OpenScene& scene) {
  if (!is_arm(opening.limb)) return std::vector<double>(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  std::vector<char> arm(scene.landmarks.triangle_parts.size());
  for (std::size_t i = 0; i < arm.size(); ++i) arm[i] = scene.landmarks.triangle_parts[i] == opening.limb;
  return nearer_to(arm, mesh, scene);
}

std::vector<double> limit_of_hem(const std::vector<Opening>& openings, const std::vector<RimCurve>& curves,
                                 const Mesh& mesh, const OpenScene& scene) {
  std::vector<char> bare(scene.landmarks.triangle_parts.size(), 1);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    if (!is_arm(openings[k].limb)) continue;
    for (std::size_t i = 0; i < bare.size(); ++i) {
      if (scene.landmarks.triangle_parts[i] != openings[k].limb) continue;
      const Vector3d& corner = scene.naked.mesh().vertices[scene.naked.mesh().triangles[i][0]];
      if (openings[k].along(corner) < curves[k].at(openings[k].angle(corner))) bare[i] = 0;
    }
  }
  if (std::find(bare.begin(), bare.end(), 0) == bare.end())
    return std::vector<double>(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  return nearer_to(bare, mesh, scene);
}

Cap make_cap(const Opening& opening, const RimCurve& curve, const Mesh& mesh, const std::vector<BodyPart>& parts,
             const std::vector<double>& limit, const Landmarks& landmarks) {
  Cap cap;
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3d& v = mesh.vertices[i];
    const double along = opening.along(v);
    cap.beyond.push_back(std::min(along - curve.at(opening.angle(v)), limit[i]));
    const double far = std::isfinite(limit[i]) ? cap.beyond.back() : along;
    if (!belongs(opening, parts[i], v, landmarks) || far <= farthest) continue;
    farthest = far;
    cap.pole = static_cast<int>(i);
  }
  return cap;
}

}  // namespace dressform
