#pragma once
#include <functional>
#include <vector>

#include "synthetic/garments/tube.h"

namespace dressform {

// Radii of a tube on a grid of stations and angles, while a garment's shape is worked out on it. Metres.
struct ClothRows {
  Tube::Frame frame;
  double s_min = 0, step = 0.006;
  int angles = 128;
  std::vector<Vector2d> centers;  // one per row
  std::vector<double> radii;      // rows x angles

  int rows() const { return static_cast<int>(centers.size()); }
  double s(int row) const { return s_min + row * step; }
  double angle(int column) const { return 6.283185307179586 * column / angles; }
  double& at(int row, int column) { return radii[static_cast<size_t>(row) * angles + column]; }
  double at(int row, int column) const { return radii[static_cast<size_t>(row) * angles + column]; }
  int row_of(double s) const;
  std::vector<Vector2d> outline(int row) const;  // in (u, v)
  Tube tube() const { return Tube(frame, s_min, step, angles, radii, centers); }
};

// The points, in the frame's (u, v), that cloth has to go round at station s; empty where there is nothing.
using Outline = std::function<std::vector<Vector2d>(double s)>;

// Convex hulls of the outlines, as taut cloth lies. Rows without points take the nearest row that has some.
// center: of the polar coordinates, by station; must lie inside every hull.
ClothRows taut_rows(const Tube::Frame& frame, double s_min, double s_max, const Outline& outline,
                    const std::function<Vector2d(double s)>& center);

// Lets the cloth span hollows along the axis: the radius may fall away from any other row's at most by `forward_slope`
// per metre in the direction of growing s, and by `backward_slope` in the other (0: hangs straight).
ClothRows span_hollows(const ClothRows& rows, double forward_slope, double backward_slope);

// Gaussian smoothing along the axis and around it.
ClothRows smoothed(const ClothRows& rows, double along_m, double around_rad);

ClothRows grown(const ClothRows& rows, double by_m);

// Smooth maximum of the two, never below the greater.
ClothRows no_smaller(const ClothRows& rows, const ClothRows& least, double blend_m);

// Adds height(s, angle) to every radius.
ClothRows displaced(const ClothRows& rows, const std::function<double(double s, double angle)>& height);

// Length of the row's convex hull.
double row_girth(const ClothRows& rows, int row);

}  // namespace dressform
