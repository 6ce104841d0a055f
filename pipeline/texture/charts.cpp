#include "pipeline/texture/charts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/core/mat.hpp>

#include "pipeline/texture/packing.h"
#include "pipeline/texture/raster.h"

namespace dressform {
namespace {

using Corners = std::array<Vector2d, 3>;

constexpr int kAxes = 6;  // +x, -x, +y, -y, +z, -z
constexpr double kSmallestScale = 0.01;
constexpr double kShrink = 0.97;      // beyond what the texture's size asks for: packing does not shrink evenly
constexpr double kNearest_m = 0.3;    // no camera stands nearer to what it shows
constexpr double kLeastFacing = 0.1;  // more oblique triangles are laid out along an axis

// Twice the area of a triangle in an image; positive where it is counter-clockwise as displayed (y is down).
double displayed_area(const Corners& c) {
  return -((c[1] - c[0]).x() * (c[2] - c[0]).y() - (c[1] - c[0]).y() * (c[2] - c[0]).x());
}

Vector3d normal_of(const Mesh& mesh, const Vector3i& t) {
  const Vector3d n =
      (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).stableNormalized();
  return n.allFinite() ? n : Vector3d::Zero();
}

// Axis that a triangle faces, 0 to 5.
int axis_of(const Vector3d& normal) {
  Eigen::Index k = 0;
  normal.cwiseAbs().maxCoeff(&k);
  return static_cast<int>(2 * k + (normal[k] < 0));
}

// Image coordinates seen from outside along an axis: right x down points into the surface.
Vector2d along_axis(int axis, const Vector3d& p, double pixels_per_m) {
  const int k = axis / 2;
  const Vector3d outward = Vector3d::Unit(k) * (axis % 2 ? -1 : 1);
  const Vector3d down = k == 1 ? Vector3d::UnitZ() : Vector3d(-Vector3d::UnitY());
  const Vector3d right = down.cross(-outward);
  return pixels_per_m * Vector2d(right.dot(p), down.dot(p));
}

// Every triangle's image before charts are cut apart; `source` says which image.
struct Layout {
  std::vector<int> source;
  std::vector<Corners> corners;
};

double pixels_per_metre(const Mesh& mesh, const std::vector<ColorView>& views) {
  constexpr double kWithoutViews = 500;  // about a Kinect's at 2 m
  if (views.empty() || mesh.vertices.empty()) return kWithoutViews;
  Vector3d center = Vector3d::Zero();
  for (const Vector3d& v : mesh.vertices) center += v / static_cast<double>(mesh.vertices.size());
  double sum = 0;
  for (const ColorView& view : views) sum += view.camera.fx / std::max(kNearest_m, (view.eye - center).norm());
  return sum / static_cast<double>(views.size());
}

Layout lay_out(const Mesh& mesh, const std::vector<ColorView>& views, const Labels& labels, double scale) {
  const double pixels_per_m = scale * pixels_per_metre(mesh, views);
  Layout layout;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    const Vector3d normal = normal_of(mesh, t);
    Corners corners;
    bool shown = labels.view[i] >= 0;
    for (int k = 0; k < 3 && shown; ++k) {
      const ColorView& view = views[labels.view[i]];
      double z_m = 0;
      shown = view.project(mesh.vertices[t[k]], corners[k], z_m) &&
              normal.dot((view.eye - mesh.vertices[t[k]]).normalized()) >= kLeastFacing;
      corners[k] *= scale;
    }
    if (shown && displayed_area(corners) > 0) {
      layout.source.push_back(labels.view[i]);
    } else {
      const int axis = axis_of(normal);
      layout.source.push_back(-1 - axis);
      for (int k = 0; k < 3; ++k) corners[k] = along_axis(axis, mesh.vertices[t[k]], pixels_per_m);
    }
    layout.corners.push_back(corners);
  }
  return layout;
}

std::vector<std::vector<int>> triangle_neighbors(const Mesh& mesh, const SurfaceGraph& graph) {
  std::vector<std::vector<int>> neighbors(mesh.triangles.size());
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    if (edge.right < 0) continue;
    neighbors[edge.left].push_back(edge.right);
    neighbors[edge.right].push_back(edge.left);
  }
  return neighbors;
}

// Connected pieces of equal source among the triangles of `open`, each in the order of a walk from its first triangle.
std::vector<std::vector<int>> pieces(const std::vector<std::vector<int>>& neighbors, const std::vector<int>& source,
                                     std::vector<bool> open) {
  std::vector<std::vector<int>> result;
  for (std::size_t first = 0; first < open.size(); ++first) {
    if (!open[first]) continue;
    std::vector<int> piece{static_cast<int>(first)};
    open[first] = false;
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (const int n : neighbors[piece[k]])
        if (open[n] && source[n] == source[piece[k]]) {
          open[n] = false;
          piece.push_back(n);
        }
    result.push_back(std::move(piece));
  }
  return result;
}

struct Chart {
  std::vector<int> triangles;
  Vector2d shift = Vector2d::Zero();  // whole pixels: place in the chart less place in the image
  cv::Size size;
};

void fit_box(Chart& chart, const Layout& layout, int gutter) {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const int i : chart.triangles)
    for (const Vector2d& corner : layout.corners[i]) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  chart.shift = Vector2d::Constant(gutter) - Vector2d(std::floor(low.x()), std::floor(low.y()));
  const Vector2d extent = high + chart.shift;
  chart.size = {static_cast<int>(std::ceil(extent.x())) + gutter + 1,
                static_cast<int>(std::ceil(extent.y())) + gutter + 1};
}

Corners shifted(const Corners& corners, const Vector2d& shift) {
  return {corners[0] + shift, corners[1] + shift, corners[2] + shift};
}

// Keeps those triangles of the chart that do not lie on one another; returns the others.
std::vector<int> drop_overlaps(Chart& chart, const Layout& layout, int gutter) {
  fit_box(chart, layout, gutter);
  cv::Mat taken(chart.size, CV_8UC1, cv::Scalar(0));
  std::vector<int> kept, dropped;
  for (const int i : chart.triangles) {
    std::vector<cv::Point> inside;
    bool free = true;
    for_each_pixel(shifted(layout.corners[i], chart.shift), {{0, 0}, chart.size},
                   [&](int x, int y, const Vector3d& weights) {
                     if (weights.minCoeff() < 1e-6) return;
                     inside.emplace_back(x, y);
                     free = free && taken.at<uchar>(y, x) == 0;
                   });
    (free ? kept : dropped).push_back(i);
    if (!free) continue;
    for (const cv::Point& p : inside) taken.at<uchar>(p) = 1;
  }
  chart.triangles = kept;
  fit_box(chart, layout, gutter);
  return dropped;
}

std::vector<Chart> cut_charts(const Mesh& mesh, const SurfaceGraph& graph, const Layout& layout, int gutter) {
  const auto neighbors = triangle_neighbors(mesh, graph);
  std::vector<Chart> charts;
  std::vector<bool> open(mesh.triangles.size(), true);
  bool more = !mesh.triangles.empty();
  while (more) {
    more = false;
    const auto found = pieces(neighbors, layout.source, open);
    open.assign(open.size(), false);
    for (const auto& piece : found) {
      Chart chart;
      chart.triangles = piece;
      for (const int i : drop_overlaps(chart, layout, gutter)) open[i] = more = true;
      charts.push_back(std::move(chart));
    }
  }
  return charts;
}

}  // namespace

Atlas make_atlas(const Mesh& mesh, const SurfaceGraph& graph, const std::vector<ColorView>& views, const Labels& labels,
                 const AtlasParams& params) {
  Atlas atlas;
  atlas.texels_per_pixel = params.texels_per_pixel;
  while (true) {
    const Layout layout = lay_out(mesh, views, labels, atlas.texels_per_pixel);
    const std::vector<Chart> charts = cut_charts(mesh, graph, layout, params.gutter_px);
    std::vector<cv::Size> boxes;
    for (const Chart& chart : charts) boxes.push_back(chart.size);
    const Packing packing = pack(boxes);
    const int largest = std::max(packing.size.width, packing.size.height);
    // Gutters do not shrink with the charts: so many charts that they alone fill the texture make it larger.
    if (largest > params.largest_px && atlas.texels_per_pixel > kSmallestScale) {
      atlas.texels_per_pixel *= kShrink * params.largest_px / largest;
      continue;
    }
    atlas.size = packing.size;
    atlas.charts = static_cast<int>(charts.size());
    atlas.corners.resize(mesh.triangles.size());
    for (std::size_t c = 0; c < charts.size(); ++c)
      for (const int i : charts[c].triangles)
        atlas.corners[i] = shifted(layout.corners[i], charts[c].shift + Vector2d(packing.at[c].x, packing.at[c].y));
    return atlas;
  }
}

}  // namespace dressform
