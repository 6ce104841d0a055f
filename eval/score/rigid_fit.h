#pragma once
#include "scenes/camera.h"
#include "scenes/mesh.h"

namespace dressform {

// The rigid motion that brings an estimated surface closest to the true one: iterated closest points, mostly to the
// tangent planes (Chen and Medioni, IVC 1992), with the farthest tenth left out, started from every turn of the axes
// and eight headings about y, centres on one another. Nothing is scaled or mirrored. Deterministic. It takes the error
// of the pose out of a comparison, so a score after it says nothing of the pose. Throws std::invalid_argument when
// either mesh has no area.
Isometry3d best_rigid_motion(const Mesh& estimate, const Mesh& truth);

}  // namespace dressform
