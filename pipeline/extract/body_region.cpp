#include "pipeline/extract/body_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/extract/depth_components.h"
#include "pipeline/geometry/floor.h"

namespace dressform {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr int kLeastPixels = 12;  // smaller pieces are specks

struct Piece {
  std::vector<Vector3d> points;
  Vector3d center = Vector3d::Zero();  // medians of the two horizontal coordinates; the height is left out
  double low_m = 0, high_m = 0;        // 2 % and 98 % heights
  double width_m = 0;                  // 2 % to 98 %, the wider of the two horizontal directions
  double indexed = 0;                  // part of the pixels that the body index claims
};

Vector3d to_vector(const cv::Vec3f& p) { return {p[0], p[1], p[2]}; }

double quantile(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Upright frame: rows are two horizontal directions and up.
Eigen::Matrix3d upright(const Vector3d& up) {
  const Vector3d side = up.cross(Vector3d(0, 0, 1)).normalized();
  Eigen::Matrix3d rows;
  rows << side.transpose(), side.cross(up).transpose(), up.transpose();
  return rows;
}

double height_of(const Vector3d& p, const BodyExpectation& expected) {
  return expected.floor ? expected.floor->head<3>().dot(p) + (*expected.floor)[3] : expected.up.dot(p);
}

void measure(Piece& piece, const BodyExpectation& expected) {
  const Eigen::Matrix3d frame = upright(expected.up);
  std::vector<double> side, depth, height;
  for (const Vector3d& p : piece.points) {
    const Vector3d local = frame * p;
    side.push_back(local.x());
    depth.push_back(local.y());
    height.push_back(height_of(p, expected));
  }
  piece.center = frame.transpose() * Vector3d(quantile(side, 0.5), quantile(depth, 0.5), 0);
  piece.low_m = quantile(height, 0.02);
  piece.high_m = quantile(height, 0.98);
  piece.width_m = std::max(quantile(side, 0.98) - quantile(side, 0.02), quantile(depth, 0.98) - quantile(depth, 0.02));
}

std::vector<Piece> pieces_of(const DepthComponents& components, const cv::Mat& points_m, const cv::Mat& body_index,
                             const BodyExpectation& expected) {
  std::vector<Piece> pieces(components.sizes.size());
  for (int y = 0; y < points_m.rows; ++y) {
    for (int x = 0; x < points_m.cols; ++x) {
      const int label = components.labels.at<int>(y, x);
      if (label < 0 || components.sizes[label] < kLeastPixels) continue;
      pieces[label].points.push_back(to_vector(points_m.at<cv::Vec3f>(y, x)));
      if (!body_index.empty() && body_index.at<uchar>(y, x) != 255) pieces[label].indexed += 1;
    }
  }
  for (Piece& piece : pieces) {
    if (piece.points.empty()) continue;
    piece.indexed /= static_cast<double>(piece.points.size());
    measure(piece, expected);
  }
  return pieces;
}

Vector3d horizontal(const Vector3d& v, const Vector3d& up) { return v - up.dot(v) * up; }

// Whether most of a piece lies on one plane.
bool is_flat(const Piece& piece, double tolerance_m) {
  const Vector4d plane = fit_plane(piece.points);
  int flat = 0;
  for (const Vector3d& p : piece.points) flat += std::abs(plane.head<3>().dot(p) + plane[3]) < tolerance_m;
  return flat > 0.7 * static_cast<double>(piece.points.size());
}

// How much a piece looks like the standing body; 0 = not at all.
double likeness(const Piece& piece, const BodyExpectation& expected, bool any_indexed) {
  if (piece.points.size() < 100) return 0;
  const double extent = piece.high_m - piece.low_m;
  if (extent < 0.25 * expected.stature_m || extent > 1.3 * expected.stature_m || piece.width_m > 1.6) return 0;
  double score = extent / expected.stature_m * std::sqrt(static_cast<double>(piece.points.size()));
  if (expected.place) {
    const double off = horizontal(piece.center - *expected.place, expected.up).norm() / expected.place_sigma_m;
    score *= std::exp(-0.5 * off * off);
  }
  // Without a prior: the rig looks at the mannequin.
  if (!expected.place) score *= std::exp(-0.5 * std::pow(piece.center.x() / 0.6, 2));
  if (is_flat(piece, 0.02)) score *= 0.05;
  if (any_indexed) score *= 0.1 + piece.indexed;
  return score;
}

double part_inside(const Piece& piece, const Vector3d& axis, const BodyExpectation& expected, double radius_m) {
  int inside = 0;
  for (const Vector3d& p : piece.points)
    inside += horizontal(p - axis, expected.up).norm() < radius_m && height_of(p, expected) < expected.stature_m + 0.15;
  return inside / static_cast<double>(piece.points.size());
}

// Planes of the large flat pieces that are not the body: walls, of which the gap between arm and body may show a bit.
std::vector<Vector4d> flat_surroundings(const std::vector<Piece>& pieces, const std::vector<bool>& taken) {
  std::vector<Vector4d> planes;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (taken[k] || pieces[k].points.size() < 1500) continue;
    if (is_flat(pieces[k], 0.03)) planes.push_back(fit_plane(pieces[k].points));
  }
  return planes;
}

bool lies_on(const Piece& piece, const std::vector<Vector4d>& planes) {
  for (const Vector4d& plane : planes) {
    int on = 0;
    for (const Vector3d& p : piece.points) on += std::abs(plane.head<3>().dot(p) + plane[3]) < 0.04;
    if (on > 0.7 * static_cast<double>(piece.points.size())) return true;
  }
  return false;
}

// The main piece and the others that belong to the same body: arms before the trunk, legs behind a skirt.
std::vector<bool> choose(const std::vector<Piece>& pieces, int main, const BodyExpectation& expected,
                         const BodyRegionParams& params) {
  std::vector<bool> taken(pieces.size(), false);
  const Vector3d axis = pieces[main].center;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (!pieces[k].points.empty()) taken[k] = part_inside(pieces[k], axis, expected, params.radius_m) > 0.85;
  taken[main] = true;
  const auto planes = flat_surroundings(pieces, taken);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (taken[k] && static_cast<int>(k) != main && lies_on(pieces[k], planes)) taken[k] = false;
  return taken;
}

cv::Mat above_floor(const cv::Mat& points_m, const BodyExpectation& expected, double margin_m) {
  cv::Mat allowed(points_m.size(), CV_8U, cv::Scalar(0));
  for (int y = 0; y < points_m.rows; ++y) {
    for (int x = 0; x < points_m.cols; ++x) {
      const auto& p = points_m.at<cv::Vec3f>(y, x);
      if (std::isnan(p[2])) continue;
      if (!expected.floor || height_of(to_vector(p), expected) > margin_m) allowed.at<uchar>(y, x) = 255;
    }
  }
  return allowed;
}

}  // namespace

BodyRegion find_body(const cv::Mat& depth_mm, const cv::Mat& points_m, const cv::Mat& body_index,
                     const BodyExpectation& expected, const BodyRegionParams& params) {
  BodyRegion result{cv::Mat::zeros(depth_mm.size(), CV_8U), false};
  const cv::Mat allowed = above_floor(points_m, expected, params.floor_margin_m);
  const auto components = depth_components(depth_mm, allowed, params.jump_mm);
  const auto pieces = pieces_of(components, points_m, body_index, expected);
  const bool any_indexed = std::any_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.indexed > 0.3; });
  int main = -1;
  double best = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const double score = likeness(pieces[k], expected, any_indexed);
    if (score <= best) continue;
    best = score;
    main = static_cast<int>(k);
  }
  if (main < 0) return result;

  const auto taken = choose(pieces, main, expected, params);
  const Vector3d axis = pieces[main].center;
  for (int y = 0; y < depth_mm.rows; ++y) {
    for (int x = 0; x < depth_mm.cols; ++x) {
      const int label = components.labels.at<int>(y, x);
      if (label < 0 || !taken[label]) continue;
      const Vector3d p = to_vector(points_m.at<cv::Vec3f>(y, x));
      if (horizontal(p - axis, expected.up).norm() > 1.3 * params.radius_m) continue;
      result.mask.at<uchar>(y, x) = 255;
    }
  }
  result.found = true;
  return result;
}

}  // namespace dressform
