#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <string>

#include "scenes/length_units.h"
#include "scenes/mesh.h"

namespace dressform {

// How the coordinates of someone's mesh file are meant. The world is in metres, y up, floor y = 0, facing +z.
struct MeshFrame {
  std::string unit = "m";  // a name of kLengthUnits
  std::string up = "y";    // the file's axis that points up: y, z (its front at -y) or x
  double lift_m = 0;       // added to the heights, after the two above
};

template <class V>
void fields(V& v, MeshFrame& frame) {
  v("unit", frame.unit, length_unit_names(), "what one unit of the mesh's coordinates is");
  v("up", frame.up, {"y", "z", "x"}, "the mesh's axis that points up");
  v("lift_m", frame.lift_m, -3.0, 3.0, "m", "how far the mesh is lifted, to stand on the floor y = 0");
}

// The mesh of a file in the world.
Mesh in_world(Mesh mesh, const MeshFrame& frame);

using Box = Eigen::AlignedBox3d;  // metres, world frame

Box bounding_box(const Mesh& mesh);

// What a mesh that lies where it cannot be, read as metres and y up, is likely meant to be: of all units and axes the
// one that `misfit` likes best (0: perfect; infinite: cannot be), in words: "; looks like centimetres (unit = "cm")".
// Empty where none fits. `as_read`: the box as `frame` has it.
std::string likely_frame(const Box& as_read, const MeshFrame& frame, const std::function<double(const Box&)>& misfit);

}  // namespace dressform
