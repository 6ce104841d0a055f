#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/types.hpp>

namespace dressform {

// Calls visit(x, y, weights) for every pixel centre (integers) of `area` in the triangle, edges included; `weights` are
// barycentric and sum to 1. Triangles without area or with a corner that is not finite are left out.
template <class Visit>
void for_each_pixel(const std::array<Eigen::Vector2d, 3>& corners, const cv::Rect& area, const Visit& visit) {
  const auto& [a, b, c] = corners;
  const double twice_area = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  if (!(std::abs(twice_area) > 1e-12) || !std::isfinite(twice_area)) return;
  const Eigen::Vector2d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const int x0 = static_cast<int>(std::max<double>(area.x, std::ceil(low.x())));
  const int x1 = static_cast<int>(std::min<double>(area.x + area.width - 1, std::floor(high.x())));
  const int y0 = static_cast<int>(std::max<double>(area.y, std::ceil(low.y())));
  const int y1 = static_cast<int>(std::min<double>(area.y + area.height - 1, std::floor(high.y())));
  constexpr double kEdge = -1e-9;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double wb = ((x - a.x()) * (c - a).y() - (y - a.y()) * (c - a).x()) / twice_area;
      const double wc = ((b - a).x() * (y - a.y()) - (b - a).y() * (x - a.x())) / twice_area;
      const double wa = 1 - wb - wc;
      if (wa >= kEdge && wb >= kEdge && wc >= kEdge) visit(x, y, Eigen::Vector3d(wa, wb, wc));
    }
}

}  // namespace dressform
