#include "scenes/mesh_frame.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "scenes/error.h"

namespace dressform {
namespace {

struct Unit {
  const char *name, *plural;
  double metres;
};
constexpr std::array<Unit, 6> kUnits{{{"m", "metres", 1},
                                      {"dm", "decimetres", 0.1},
                                      {"cm", "centimetres", 0.01},
                                      {"mm", "millimetres", 0.001},
                                      {"inch", "inches", 0.0254},
                                      {"foot", "feet", 0.3048}}};
constexpr std::array<const char*, 3> kUps{"y", "z", "x"};

double metres_of(const std::string& unit) {
  for (const Unit& known : kUnits)
    if (unit == known.name) return known.metres;
  throw InputError("unit", "found \"" + unit + "\"; expected m, dm, cm, mm, inch or foot");
}

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
  const Eigen::Matrix3d motion = metres_of(frame.unit) * world_from_axes(frame.up);
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
  file = moved(file, (metres_of(frame.unit) * world_from_axes(frame.up)).inverse());
  double best = INFINITY;
  std::string words;
  for (const char* up : kUps)
    for (const Unit& unit : kUnits) {
      const double found = misfit(moved(file, unit.metres * world_from_axes(up)));
      if (!(found < best)) continue;
      best = found;
      words = fmt::format("; looks like {} with {} up (unit = \"{}\", up = \"{}\")", unit.plural, up, unit.name, up);
    }
  return words;
}

}  // namespace dressform
