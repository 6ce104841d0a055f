#include "synthetic/garments/cloth_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "synthetic/body/section.h"

namespace dressform {
namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Where the ray from `center` leaves a convex polygon.
double ray_length(const std::vector<Vector2d>& hull, const Vector2d& center, const Vector2d& direction) {
  double best = 0;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Vector2d a = hull[i] - center, edge = hull[(i + 1) % hull.size()] - hull[i];
    const double denominator = cross(direction, edge);
    if (std::abs(denominator) < 1e-15) continue;
    const double along_edge = cross(a, direction) / denominator, along_ray = cross(a, edge) / denominator;
    if (along_edge >= -1e-9 && along_edge <= 1 + 1e-9) best = std::max(best, along_ray);
  }
  return best;
}

// Rows that were left at zero take the nearest filled row.
void fill_empty_rows(ClothRows& rows, const std::vector<char>& filled) {
  for (int row = 0; row < rows.rows(); ++row) {
    if (filled[row]) continue;
    for (int away = 1; away < rows.rows(); ++away) {
      const int below = row - away, above = row + away;
      const int source = below >= 0 && filled[below] ? below : above < rows.rows() && filled[above] ? above : -1;
      if (source < 0) continue;
      for (int i = 0; i < rows.angles; ++i) rows.at(row, i) = rows.at(source, i);
      break;
    }
  }
}

}  // namespace

int ClothRows::row_of(double at) const {
  return std::clamp(static_cast<int>(std::lround((at - s_min) / step)), 0, rows() - 1);
}

std::vector<Vector2d> ClothRows::outline(int row) const {
  std::vector<Vector2d> points;
  for (int i = 0; i < angles; ++i)
    points.push_back(centers[row] + at(row, i) * Vector2d(std::cos(angle(i)), std::sin(angle(i))));
  return points;
}

ClothRows taut_rows(const Tube::Frame& frame, double s_min, double s_max, const Outline& outline,
                    const std::function<Vector2d(double s)>& center) {
  ClothRows rows;
  rows.frame = frame;
  rows.s_min = s_min;
  const int count = std::max(4, static_cast<int>(std::ceil((s_max - s_min) / rows.step)) + 1);
  rows.centers.resize(count);
  rows.radii.assign(static_cast<size_t>(count) * rows.angles, 0);
  std::vector<char> filled(count, 0);
  tbb::parallel_for(0, count, [&](int row) {
    rows.centers[row] = center(rows.s(row));
    const std::vector<Vector2d> hull = convex_hull(outline(rows.s(row)));
    if (hull.size() < 3) return;
    for (int i = 0; i < rows.angles; ++i) {
      const double angle = rows.angle(i);
      rows.at(row, i) = ray_length(hull, rows.centers[row], Vector2d(std::cos(angle), std::sin(angle)));
    }
    filled[row] = 1;
  });
  if (std::count(filled.begin(), filled.end(), 1) == 0)
    throw std::runtime_error("taut_rows: nothing to go round at any station");
  fill_empty_rows(rows, filled);
  return rows;
}

ClothRows span_hollows(const ClothRows& rows, double forward_slope, double backward_slope) {
  ClothRows result = rows;
  for (int i = 0; i < rows.angles; ++i) {
    for (int row = 1; row < rows.rows(); ++row)
      result.at(row, i) = std::max(result.at(row, i), result.at(row - 1, i) - forward_slope * rows.step);
    for (int row = rows.rows() - 2; row >= 0; --row)
      result.at(row, i) = std::max(result.at(row, i), result.at(row + 1, i) - backward_slope * rows.step);
  }
  return result;
}

ClothRows smoothed(const ClothRows& rows, double along_m, double around_rad) {
  const auto kernel = [](double sigma) {
    const int reach = static_cast<int>(std::ceil(2.5 * sigma));
    std::vector<double> weights(2 * reach + 1);
    double sum = 0;
    for (int i = -reach; i <= reach; ++i)
      sum += weights[i + reach] = std::exp(-0.5 * i * i / std::max(1e-9, sigma * sigma));
    for (double& w : weights) w /= sum;
    return weights;
  };
  const std::vector<double> along = kernel(along_m / rows.step);
  const std::vector<double> around = kernel(around_rad * rows.angles / 6.283185307179586);
  ClothRows middle = rows, result = rows;
  const int reach_along = static_cast<int>(along.size() / 2), reach_around = static_cast<int>(around.size() / 2);
  for (int row = 0; row < rows.rows(); ++row)
    for (int i = 0; i < rows.angles; ++i) {
      double sum = 0;
      for (int k = -reach_along; k <= reach_along; ++k)
        sum += along[k + reach_along] * rows.at(std::clamp(row + k, 0, rows.rows() - 1), i);
      middle.at(row, i) = sum;
    }
  for (int row = 0; row < rows.rows(); ++row)
    for (int i = 0; i < rows.angles; ++i) {
      double sum = 0;
      for (int k = -reach_around; k <= reach_around; ++k)
        sum += around[k + reach_around] * middle.at(row, (i + k + rows.angles) % rows.angles);
      result.at(row, i) = sum;
    }
  return result;
}

ClothRows grown(const ClothRows& rows, double by_m) {
  ClothRows result = rows;
  for (double& r : result.radii) r += by_m;
  return result;
}

ClothRows no_smaller(const ClothRows& rows, const ClothRows& least, double blend_m) {
  ClothRows result = rows;
  for (size_t i = 0; i < result.radii.size(); ++i) {
    const double a = rows.radii[i], b = least.radii[i], h = std::max(blend_m - std::abs(a - b), 0.0);
    result.radii[i] = std::max(a, b) + h * h / (4 * blend_m);
  }
  return result;
}

ClothRows displaced(const ClothRows& rows, const std::function<double(double s, double angle)>& height) {
  ClothRows result = rows;
  tbb::parallel_for(0, rows.rows(), [&](int row) {
    for (int i = 0; i < rows.angles; ++i) result.at(row, i) += height(rows.s(row), rows.angle(i));
  });
  return result;
}

double row_girth(const ClothRows& rows, int row) { return polygon_length(convex_hull(rows.outline(row))); }

}  // namespace dressform
