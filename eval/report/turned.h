#pragma once
#include "pipeline/reconstruct.h"
#include "scenes/mesh.h"

namespace dressform {

// The heading of a model frame means nothing; images turn it about y so that a chosen viewer stands at +z.

// Azimuth (radians about y, 0 at +z) from which the first registered sensor looks at the model; 0 when none is.
double front_heading(const Reconstruction& reconstruction);
// Azimuth of the scanner's first frame; 0 when there is none.
double scan_heading(const BodyModel& model);

// The point, mesh or garment turned so that `heading` comes to +z.
Vector3d turned(const Vector3d& point, double heading);
Mesh turned(const Mesh& mesh, double heading);
TexturedMesh turned(const TexturedMesh& mesh, double heading);

}  // namespace dressform
