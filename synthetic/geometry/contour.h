#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "scenes/mesh.h"
#include "synthetic/geometry/solid.h"

namespace dressform {

// The zero level of a field as a closed mesh, outward: dual marching cubes (Nielson, Visualization 2004) on a grid of
// `step_m`, then the vertices are spread evenly over the surface and put back onto it. The box must hold the whole
// solid. The field's slope may be off from 1 by a factor of two. Edges are about `step_m` long. Throws
// std::runtime_error when no placement of the grid gives a closed manifold, or none a surface.
Mesh contour(const Field& field, const Eigen::AlignedBox3d& box, double step_m);

// The same for solids that may have no closed surface on such a grid: nothing then.
std::optional<Mesh> closed_contour(const Field& field, const Eigen::AlignedBox3d& box, double step_m);

// Moves points onto the zero level by Newton steps along the field's gradient.
void project_to_surface(const Field& field, std::vector<Vector3d>& points, int iterations);

}  // namespace dressform
