#include "pipeline/extract/body_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/extract/depth_components.h"
#include "pipeline/geometry/floor.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr int kLeastPixels = 12;                    // smaller pieces are specks
constexpr std::size_t kLeastOfBody = 100;           // pixels of what may be the body's main piece
constexpr double kShortest = 0.25, kTallest = 1.3;  // of the stature: a piece of it, and it on a stand with arms up
constexpr double kWidest_m = 1.6;                   // arms stretched out to the sides
constexpr double kOffCenter_m = 0.6;  // sigma of the body's place off the optical axis, without a rig prior
constexpr double kStray = 0.02;       // part of a piece's points at either end that say nothing of its size
constexpr double kFlatPart = 0.7;     // of a piece's points on one plane, for it to be flat
constexpr double kFlatBand_m = 0.02, kWallBand_m = 0.03, kOnWallBand_m = 0.04;  // to either side of the plane
constexpr double kFlatLikeness = 0.05;      // of a flat piece: a door may be as tall as a body
constexpr double kUnindexed = 0.1;          // likeness of a piece that the body index leaves out
constexpr double kIndexed = 0.3;            // part of a piece from which on the body index means it
constexpr std::size_t kLeastOfWall = 1500;  // pixels
constexpr double kInside = 0.85;            // of a piece's points in the body's cylinder, for it to belong to the body
constexpr double kAbove_m = 0.15;           // hair and a raised hand above the stature
constexpr double kReach = 1.3;              // of the cylinder's radius, for single pixels of pieces taken

struct Piece {
  std::vector<Vector3d> points;
  Vector3d center = Vector3d::Zero();  // medians of the two horizontal coordinates; the height is left out
  double low_m = 0, high_m = 0;        // 2 % and 98 % heights
  double width_m = 0;                  // 2 % to 98 %, the wider of the two horizontal directions
  double indexed = 0;                  // part of the pixels that the body index claims
};

Vector3d to_vector(const cv::Vec3f& p) { return {p[0], p[1], p[2]}; }

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
  const auto width = [](const std::vector<double>& c) {
    return lower_quantile(c, 1 - kStray) - lower_quantile(c, kStray);
  };
  piece.center = frame.transpose() * Vector3d(lower_quantile(side, 0.5), lower_quantile(depth, 0.5), 0);
  piece.low_m = lower_quantile(height, kStray);
  piece.high_m = lower_quantile(height, 1 - kStray);
  piece.width_m = std::max(width(side), width(depth));
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
  return flat > kFlatPart * static_cast<double>(piece.points.size());
}

// How much a piece looks like the standing body; 0 = not at all.
double likeness(const Piece& piece, const BodyExpectation& expected, bool any_indexed) {
  if (piece.points.size() < kLeastOfBody) return 0;
  const double extent = piece.high_m - piece.low_m;
  if (extent < kShortest * expected.stature_m || extent > kTallest * expected.stature_m || piece.width_m > kWidest_m)
    return 0;
  double score = extent / expected.stature_m * std::sqrt(static_cast<double>(piece.points.size()));
  if (expected.place) {
    const double off = horizontal(piece.center - *expected.place, expected.up).norm() / expected.place_sigma_m;
    score *= std::exp(-0.5 * off * off);
  }
  // Without a prior: the rig looks at the mannequin.
  if (!expected.place) score *= std::exp(-0.5 * std::pow(piece.center.x() / kOffCenter_m, 2));
  if (is_flat(piece, kFlatBand_m)) score *= kFlatLikeness;
  if (any_indexed) score *= kUnindexed + piece.indexed;
  return score;
}

double part_inside(const Piece& piece, const Vector3d& axis, const BodyExpectation& expected, double radius_m) {
  int inside = 0;
  for (const Vector3d& p : piece.points)
    inside +=
        horizontal(p - axis, expected.up).norm() < radius_m && height_of(p, expected) < expected.stature_m + kAbove_m;
  return inside / static_cast<double>(piece.points.size());
}

// Planes of the large flat pieces that are not the body: walls, of which the gap between arm and body may show a bit.
std::vector<Vector4d> flat_surroundings(const std::vector<Piece>& pieces, const std::vector<bool>& taken) {
  std::vector<Vector4d> planes;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (taken[k] || pieces[k].points.size() < kLeastOfWall) continue;
    if (is_flat(pieces[k], kWallBand_m)) planes.push_back(fit_plane(pieces[k].points));
  }
  return planes;
}

bool lies_on(const Piece& piece, const std::vector<Vector4d>& planes) {
  for (const Vector4d& plane : planes) {
    int on = 0;
    for (const Vector3d& p : piece.points) on += std::abs(plane.head<3>().dot(p) + plane[3]) < kOnWallBand_m;
    if (on > kFlatPart * static_cast<double>(piece.points.size())) return true;
  }
  return false;
}

// The main piece and the others that belong to the same body: arms before the trunk, legs behind a skirt.
std::vector<bool> choose(const std::vector<Piece>& pieces, int main, const BodyExpectation& expected,
                         const BodyRegionParams& params) {
  std::vector<bool> taken(pieces.size(), false);
  const Vector3d axis = pieces[main].center;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (!pieces[k].points.empty()) taken[k] = part_inside(pieces[k], axis, expected, params.radius_m) > kInside;
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
  const bool any_indexed =
      std::any_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.indexed > kIndexed; });
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
      if (horizontal(p - axis, expected.up).norm() > kReach * params.radius_m) continue;
      result.mask.at<uchar>(y, x) = 255;
    }
  }
  result.found = true;
  return result;
}

}  // namespace dressform
