#include "scenes/mesh_frame.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "scenes/error.h"
#include "scenes/length_units.h"

namespace dressform {
namespace {

constexpr std::array<const char*, 3> kUps{"y", "z", "x"};

// Rotations only: nothing is mirrored.
Eigen::Matrix3d world_from_axes(const std::string& up) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (up == "z") axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  if (up == "x") axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  if (up != "x" && up != "y" && up != "z") throw InputError("up", "found \"" + up + "\"; expected y, z or x");
  return axes;
}

Box moved(const Box& box, const Eigen::Matrix3d& motion) {
  Box result;
  result.extend(motion * box.min());
  result.extend(motion * box.max());
  return result;
}

}  // namespace

Mesh in_world(Mesh mesh, const MeshFrame& frame) {
  if (frame.unit == "m" && frame.up == "y" && frame.lift_m == 0) return mesh;
  const Eigen::Matrix3d motion = metres_in(frame.unit) * world_from_axes(frame.up);
  for (Vector3d& vertex : mesh.vertices) vertex = (motion * vertex + Vector3d(0, frame.lift_m, 0)).eval();
  return mesh;
}

Box bounding_box(const Mesh& mesh) {
  Box box;
  for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

std::string likely_frame(const Box& as_read, const MeshFrame& frame, const std::function<double(const Box&)>& misfit) {
  Box file = as_read;
  file.translate(Vector3d(0, -frame.lift_m, 0));
  file = moved(file, (metres_in(frame.unit) * world_from_axes(frame.up)).inverse());
  double best = INFINITY;
  std::string words;
  for (const char* up : kUps)
    for (const LengthUnit& unit : kLengthUnits) {
      const double found = misfit(moved(file, unit.metres * world_from_axes(up)));
      if (!(found < best)) continue;
      best = found;
      words = fmt::format("; looks like {} with {} up (unit = \"{}\", up = \"{}\")", unit.plural, up, unit.name, up);
    }
  return words;
}

}  // namespace dressform
