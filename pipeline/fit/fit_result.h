#pragma once
#include <string>
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/fit/fit.h"
#include "pipeline/geometry/mesh_query.h"

namespace dressform {

// Throws InputError when a body is missing or shows no trunk; `variant` names the variant for the message.
void require_bodies(const KnownBody& naked, const KnownBody& user, const std::string& variant);

// The naked model's frame turned and shifted about the vertical to face as the user does and stand where the user does,
// and scaled about the floor below the trunk.
Eigen::Matrix4d user_from_naked(const Landmarks& naked, const Landmarks& user, double scale = 1);

// The same triangles and texture with other vertices; counts the triangles that turned over against `foldover_of`.
TexturedMesh with_vertices(const TexturedMesh& garment, std::vector<Vector3d> vertices);
int count_foldovers(const Mesh& before, const Mesh& after);

// The layout of a garment on the mannequin. Throws InputError naming the variant where there is none.
const GarmentLayout& layout_of(const std::string& garment, const GarmentLayouts& layouts, const std::string& variant);

// Puts a garment with its new vertices into the result, with its layout on the user's body.
void add_fitted(const std::string& name, const TexturedMesh& garment, std::vector<Vector3d> vertices,
                const GarmentLayout& layout, const KnownBody& user, const MeshQuery& user_surface,
                FittedGarments& result);

// Root mean square distance of the vertices of `body` to the surface, m.
double rms_distance(const Mesh& body, const MeshQuery& surface);

}  // namespace dressform
