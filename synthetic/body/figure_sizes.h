#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "synthetic/body/body.h"
#include "synthetic/body/section.h"
#include "synthetic/body/survey.h"
#include "synthetic/geometry/solid.h"

namespace dressform {

// A plane in which a body is measured: through `origin`, which lies inside the limb or trunk, spanned by the unit
// vectors u (breadth) and v (depth).
struct SizePlane {
  Vector3d origin, u, v;
};

// The outline of a body in a plane, round the plane's origin: (u, v) from the origin, metres. Empty: none there.
using Slicer = std::function<std::vector<Vector2d>(const SizePlane&)>;

// Rays from the origin to the field's surface.
Slicer field_slicer(const Field& field);
// The curve of the mesh's section that goes round the origin, the innermost one.
Slicer mesh_slicer(const Mesh& mesh);

// Measures a figure like the survey: girths (tape: convex hull), breadths and depths of trunk, limbs, neck and head in
// the planes that landmarks and joints give. Heights and segment lengths are the landmarks' and joints' own, hands and
// feet are left 0. Metres.
BodySizes measure_sizes(const BodyLandmarks& landmarks, const std::map<std::string, Vector3d>& joints,
                        const Slicer& slice);

// Middle of the neck where it is measured, and the direction in which it leans upwards.
struct NeckPlace {
  Vector3d center, axis;
};
NeckPlace neck_place(const BodyLandmarks& landmarks);

}  // namespace dressform
