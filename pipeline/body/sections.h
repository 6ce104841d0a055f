#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// One closed curve of a horizontal section, x and z of its points; counter-clockwise seen from below (x to z).
struct SectionLoop {
  std::vector<Vector3d> points;
  Vector3d centroid = Vector3d::Zero();
  double area_m2 = 0;
};

// Sections of a closed mesh with the planes y = first_y + i step, outer loops only, largest area first.
struct Sections {
  double first_y = 0, step = 0.01;
  std::vector<std::vector<SectionLoop>> levels;

  double y(int level) const { return first_y + level * step; }
  int level(double height) const;  // the nearest one that exists; -1 if there is none
};
Sections horizontal_sections(const Mesh& mesh, double step_m = 0.01);

// Whether (x, z) of the point lies inside the loop.
bool contains(const SectionLoop& loop, const Vector3d& point);

// Girth of the convex hull of a loop, m: what a tape measures.
double tape_girth(const SectionLoop& loop);

}  // namespace dressform
