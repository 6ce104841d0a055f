#pragma once
#include <optional>
#include <vector>

#include "scenes/mesh.h"

namespace dressform::metrics {

// One connected line of a horizontal section, as (x, z).
struct SectionLine {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
};
// Section of a mesh with the plane at height y (vertices at y count as above).
std::vector<SectionLine> horizontal_section(const Mesh& mesh, double y);

// Length of the convex hull's outline: what a tape measures.
double hull_girth_m(const std::vector<Eigen::Vector2d>& points);

double signed_area(const std::vector<Eigen::Vector2d>& points);

// How a standing body is laid out, found where two legs are: the direction from leg to leg and the middle between them.
struct BodyAxes {
  double low_y = 0, stature = 0;
  Eigen::Vector2d side = Eigen::Vector2d::UnitX(), middle = Eigen::Vector2d::Zero();  // (x, z)
};
std::optional<BodyAxes> body_axes(const Mesh& body);  // absent where there are no two legs

// Front-to-back thickness of what the lines enclose, metres, along the line across the body at `aside` from its middle.
double thickness_at(const std::vector<SectionLine>& lines, const BodyAxes& axes, double aside);

// The trunk's part of a section. An arm that touches the trunk, or is joined to it by a web, is cut off where the
// section is thinnest between the two.
struct TrunkSection {
  std::vector<Eigen::Vector2d> outline;
  std::vector<std::vector<Eigen::Vector2d>> limbs;  // all the rest
  double bridge = 0;        // thickness where an arm is cut off over the trunk's; 0 where none is
  double half_breadth = 0;  // of the outline, to the further side
};
TrunkSection trunk_section(const std::vector<SectionLine>& lines, const BodyAxes& axes);

}  // namespace dressform::metrics
