#pragma once
#include <optional>
#include <vector>

#include "pipeline/extract/body_region.h"
#include "pipeline/geometry/mesh_query.h"
#include "scenes/camera.h"

namespace dressform {

// Where the naked model stands in one view, to a few centimetres: upright on the view's floor (or by `up`, with its
// height open, where no floor was seen), its place and heading those at which the view's points lie nearest to its
// surface. points: of the body, sensor frame, m. Closest points and least squares in the upright motions alone (Besl
// and McKay, PAMI 1992), from starts all round. Empty for fewer than 100 points or a model without triangles.
std::optional<Isometry3d> model_stance(const std::vector<Vector3d>& points, const Vector3d& up,
                                       const std::optional<Eigen::Vector4d>& floor, const MeshQuery& model);

}  // namespace dressform
