#pragma once
#include <cstdint>
#include <vector>

#include "synthetic/geometry/contour.h"

namespace dressform {

// Samples of the field on a grid; only blocks of cells near the surface are sampled exactly.
struct ContourGrid {
  static constexpr int kBlock = 8;  // cells along a block's edge

  Vector3d origin;
  double step;
  Vector3i size;  // samples along x, y, z
  std::vector<float> values;
  std::vector<std::uint8_t> sampled;  // per block of cells
  Vector3i blocks;

  size_t at(int x, int y, int z) const { return (static_cast<size_t>(z) * size.y() + y) * size.x() + x; }
  Vector3d point(int x, int y, int z) const { return origin + step * Vector3d(x, y, z); }
};

// The grid over the box, with a margin of two steps, its samples moved by `shift` (in steps). On all threads.
ContourGrid sample_near_surface(const Field& field, const Eigen::AlignedBox3d& box, double step_m,
                                const Vector3d& shift);

}  // namespace dressform
