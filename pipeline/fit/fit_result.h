#pragma once
#include <string>
#include <vector>

#include "pipeline/fit/fit.h"
#include "pipeline/geometry/mesh_query.h"

namespace dressform {

// Throws InputError when a body is missing; `variant` names the variant for the message.
void require_bodies(const BodyModel& naked, const BodyModel& user, const std::string& variant);

// The same triangles and texture with other vertices; counts the triangles that turned over against `foldover_of`.
TexturedMesh with_vertices(const TexturedMesh& garment, std::vector<Vector3d> vertices);
int count_foldovers(const Mesh& before, const Mesh& after);

// Root mean square distance of the vertices of `body` to the surface, m.
double rms_distance(const Mesh& body, const MeshQuery& surface);

}  // namespace dressform
