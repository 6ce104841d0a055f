#include "pipeline/texture/paint.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/texture/gains.h"
#include "pipeline/texture/raster.h"

namespace dressform {
namespace {

constexpr float kGrazing = 0.17f;           // cosine of 80 degrees; twice it is 70
constexpr int kGutterSteps = 4;             // pixels by which colours grow into gutters before coarser images fill
constexpr float kSomeTrust = 0.02f;         // from here on a colour counts in full
constexpr float kFallback = 1e-3f;          // weight of views that were not chosen, for where the chosen one fails
const cv::Vec3f kUncolored(128, 128, 128);  // where no view colours anything

// What lies under every texel.
struct TexelGrid {
  cv::Mat triangle;  // int32, -1 = none
  cv::Mat weights;   // float32 x 3, barycentric
};

TexelGrid rasterized(const Atlas& atlas) {
  TexelGrid grid{cv::Mat(atlas.size, CV_32SC1, cv::Scalar(-1)), cv::Mat(atlas.size, CV_32FC3, cv::Scalar::all(0))};
  for (std::size_t i = 0; i < atlas.corners.size(); ++i)
    for_each_pixel(atlas.corners[i], {{0, 0}, atlas.size}, [&](int x, int y, const Vector3d& w) {
      if (grid.triangle.at<int>(y, x) >= 0) return;
      grid.triangle.at<int>(y, x) = static_cast<int>(i);
      grid.weights.at<cv::Vec3f>(y, x) =
          cv::Vec3f(static_cast<float>(w[0]), static_cast<float>(w[1]), static_cast<float>(w[2]));
    });
  return grid;
}

// 0 where a surface is more oblique than about 80 degrees, 1 from 70 degrees on.
float facing_factor(float facing) {
  const float t = std::clamp((facing - kGrazing) / kGrazing, 0.f, 1.f);
  return t * t * (3 - 2 * t);
}

// Known colours averaged over a hand's breadth of known surface, so that a piece of print at the edge of what was seen
// is not drawn out over the unseen.
Eigen::MatrixXf plain_colors(const SurfaceGraph& graph, Eigen::MatrixXf colors, const std::vector<bool>& known) {
  constexpr double kReachM = 0.04;
  Eigen::MatrixXf weighted(colors.rows(), 4);
  for (Eigen::Index v = 0; v < colors.rows(); ++v) {
    const float weight = known[v] ? 1.f : 0.f;
    weighted.row(v) << weight * colors.row(v), weight;
  }
  weighted = spread_over_surface(graph, std::move(weighted), kReachM);
  for (Eigen::Index v = 0; v < colors.rows(); ++v)
    if (known[v]) colors.row(v) = weighted.row(v).head<3>() / weighted(v, 3);
  return colors;
}

Eigen::MatrixXf filled_vertex_colors(const SurfaceGraph& graph, const VertexSamples& samples,
                                     const BlendWeights& weights, const Eigen::MatrixXf& unlit) {
  const Eigen::Index count = samples.trust.rows();
  Eigen::MatrixXf colors = Eigen::MatrixXf::Constant(count, 3, kUncolored[0]);
  std::vector<bool> known(count, false);
  for (Eigen::Index v = 0; v < count; ++v) {
    float sum = 0, best = 0;
    Eigen::RowVector3f color = Eigen::RowVector3f::Zero();
    for (Eigen::Index i = 0; i < samples.trust.cols(); ++i) {
      const float valid = samples.trust(v, i) * facing_factor(samples.facing(v, i));
      const float w = (weights.low(v, i) + kFallback) * valid;
      color += w * samples.low[i].row(v);
      sum += w;
      best = std::max(best, valid);
    }
    known[v] = best > kSomeTrust;
    if (!known[v]) continue;
    for (int c = 0; c < 3; ++c) colors(v, c) = unlit.rows() ? with_gain(color[c] / sum, unlit(v, c)) : color[c] / sum;
  }
  return fill_over_surface(graph, plain_colors(graph, std::move(colors), known), known);
}

class Painter {
 public:
  Painter(const Mesh& mesh, const std::vector<ColorView>& views, const VertexSamples& samples,
          const BlendWeights& weights, const Eigen::MatrixXf& vertex_colors, const Eigen::MatrixXf& unlit,
          const ViewParams& params)
      : mesh_(mesh),
        views_(views),
        samples_(samples),
        weights_(weights),
        vertex_colors_(vertex_colors),
        unlit_(unlit),
        params_(params) {}

  // Colour (BGR levels) of a point on the surface; `seen` is false where no view gives one.
  cv::Vec3f operator()(const Vector3i& t, const cv::Vec3f& b, bool& seen) const {
    const Vector3d point = static_cast<double>(b[0]) * mesh_.vertices[t[0]] +
                           static_cast<double>(b[1]) * mesh_.vertices[t[1]] +
                           static_cast<double>(b[2]) * mesh_.vertices[t[2]];
    cv::Vec3f low(0, 0, 0), high(0, 0, 0);
    float low_sum = 0, high_sum = 0, best = 0;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const float facing = mixed(samples_.facing, t, b, column);
      if (facing <= 0) continue;
      Vector2d pixel;
      double z_m = 0;
      if (!views_[i].project(point, pixel, z_m)) continue;
      const float valid = views_[i].trust_at(pixel, z_m, params_.occluder_gap_m) * facing_factor(facing);
      if (valid <= 0) continue;
      const float fallback = kFallback * facing * facing;
      const float low_weight = (mixed(weights_.low, t, b, column) + fallback) * valid;
      const float high_weight = (mixed(weights_.high, t, b, column) + fallback) * valid;
      const cv::Vec3f coarse = linear3(views_[i].low, pixel);
      low += coarse * low_weight;
      high += (cubic3(views_[i].color, pixel) - coarse) * high_weight;
      low_sum += low_weight;
      high_sum += high_weight;
      best = std::max(best, valid);
    }
    seen = best > 0;
    cv::Vec3f along_surface;
    for (int c = 0; c < 3; ++c) along_surface[c] = mixed(vertex_colors_, t, b, c);
    if (!seen) return along_surface;
    const float part = std::min(1.f, best / kSomeTrust);
    cv::Vec3f color = low * (1 / low_sum) + high * (1 / high_sum);
    if (unlit_.rows())
      for (int c = 0; c < 3; ++c) color[c] = with_gain(color[c], mixed(unlit_, t, b, c));
    return color * part + along_surface * (1 - part);
  }

 private:
  static float mixed(const Eigen::MatrixXf& values, const Vector3i& t, const cv::Vec3f& b, Eigen::Index column) {
    return b[0] * values(t[0], column) + b[1] * values(t[1], column) + b[2] * values(t[2], column);
  }
  const Mesh& mesh_;
  const std::vector<ColorView>& views_;
  const VertexSamples& samples_;
  const BlendWeights& weights_;
  const Eigen::MatrixXf& vertex_colors_;
  const Eigen::MatrixXf& unlit_;
  const ViewParams& params_;
};

// Colours spread outwards into empty texels: a few pixels by the mean of their neighbours, for the gutters, and the
// rest from ever coarser images, so that no mipmap level mixes in a foreign colour.
cv::Mat without_gaps(cv::Mat color, cv::Mat covered) {
  const auto grown = [](const cv::Mat& values, const cv::Mat& mask, cv::Mat& sum, cv::Mat& weight) {
    cv::Mat masked;
    values.copyTo(masked, mask);
    cv::boxFilter(masked, sum, CV_32F, {3, 3}, {-1, -1}, false, cv::BORDER_CONSTANT);
    cv::Mat ones;
    mask.convertTo(ones, CV_32F, 1 / 255.0);
    cv::boxFilter(ones, weight, CV_32F, {3, 3}, {-1, -1}, false, cv::BORDER_CONSTANT);
  };
  for (int step = 0; step < kGutterSteps; ++step) {
    cv::Mat sum, weight;
    grown(color, covered, sum, weight);
    for (int y = 0; y < color.rows; ++y)
      for (int x = 0; x < color.cols; ++x)
        if (!covered.at<uchar>(y, x) && weight.at<float>(y, x) > 0.5f)
          color.at<cv::Vec3f>(y, x) = sum.at<cv::Vec3f>(y, x) * (1 / weight.at<float>(y, x));
    covered |= weight > 0.5f;
  }
  if (color.total() <= 4 || cv::countNonZero(covered) == static_cast<int>(color.total())) return color;
  if (cv::countNonZero(covered) == 0) return cv::Mat(color.size(), CV_32FC3, kUncolored);
  cv::Mat weight, masked, small, small_weight;
  covered.convertTo(weight, CV_32F, 1 / 255.0);
  color.copyTo(masked, covered);
  const cv::Size half((color.cols + 1) / 2, (color.rows + 1) / 2);
  cv::resize(masked, small, half, 0, 0, cv::INTER_AREA);
  cv::resize(weight, small_weight, half, 0, 0, cv::INTER_AREA);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      if (small_weight.at<float>(y, x) > 0) small.at<cv::Vec3f>(y, x) *= 1 / small_weight.at<float>(y, x);
  const cv::Mat coarse = without_gaps(small, small_weight > 0);
  cv::Mat filled;
  cv::resize(coarse, filled, color.size(), 0, 0, cv::INTER_LINEAR);
  color.copyTo(filled, covered);
  return filled;
}

double unseen_part(const Mesh& mesh, const SurfaceGraph& graph, const VertexSamples& samples, const TexelGrid& grid,
                   const cv::Mat& seen) {
  std::vector<int> texels(mesh.triangles.size(), 0), seen_texels(mesh.triangles.size(), 0);
  for (int y = 0; y < seen.rows; ++y)
    for (int x = 0; x < seen.cols; ++x)
      if (const int i = grid.triangle.at<int>(y, x); i >= 0) {
        ++texels[i];
        seen_texels[i] += seen.at<uchar>(y, x) != 0;
      }
  double area = 0, unseen = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    const bool corner_seen =
        samples.trust.cols() > 0 &&
        (samples.trust.row(t[0]) + samples.trust.row(t[1]) + samples.trust.row(t[2])).maxCoeff() > 0;
    const double part = texels[i] ? seen_texels[i] / static_cast<double>(texels[i]) : corner_seen ? 1 : 0;
    area += graph.triangle_area_m2[i];
    unseen += graph.triangle_area_m2[i] * (1 - part);
  }
  return area > 0 ? unseen / area : 1;
}

}  // namespace

Painted paint(const Mesh& mesh, const SurfaceGraph& graph, const std::vector<ColorView>& views,
              const VertexSamples& samples, const Atlas& atlas, const BlendWeights& weights,
              const Eigen::MatrixXf& unlit, const ViewParams& params) {
  const TexelGrid grid = rasterized(atlas);
  const Eigen::MatrixXf vertex_colors = filled_vertex_colors(graph, samples, weights, unlit);
  const Painter painter(mesh, views, samples, weights, vertex_colors, unlit, params);
  cv::Mat color(atlas.size, CV_32FC3, cv::Scalar::all(0)), seen(atlas.size, CV_8UC1, cv::Scalar(0));
  tbb::parallel_for(0, atlas.size.height, [&](int y) {
    for (int x = 0; x < atlas.size.width; ++x) {
      const int i = grid.triangle.at<int>(y, x);
      if (i < 0) continue;
      bool here = false;
      color.at<cv::Vec3f>(y, x) = painter(mesh.triangles[i], grid.weights.at<cv::Vec3f>(y, x), here);
      seen.at<uchar>(y, x) = here ? 255 : 0;
    }
  });
  Painted painted;
  without_gaps(color, grid.triangle >= 0).convertTo(painted.texture, CV_8UC3);
  painted.unseen_part = unseen_part(mesh, graph, samples, grid, seen);
  return painted;
}

cv::Mat paint_vertex_colors(const Mesh& mesh, const Atlas& atlas, const Eigen::MatrixXf& colors) {
  const TexelGrid grid = rasterized(atlas);
  cv::Mat color(atlas.size, CV_32FC3, cv::Scalar::all(0)), texture;
  for (int y = 0; y < color.rows; ++y)
    for (int x = 0; x < color.cols; ++x) {
      const int i = grid.triangle.at<int>(y, x);
      if (i < 0) continue;
      const cv::Vec3f& b = grid.weights.at<cv::Vec3f>(y, x);
      const Vector3i& t = mesh.triangles[i];
      for (int c = 0; c < 3; ++c)
        color.at<cv::Vec3f>(y, x)[c] = b[0] * colors(t[0], c) + b[1] * colors(t[1], c) + b[2] * colors(t[2], c);
    }
  without_gaps(color, grid.triangle >= 0).convertTo(texture, CV_8UC3);
  return texture;
}

std::vector<std::array<Vector2f, 3>> texture_coordinates(const Atlas& atlas) {
  std::vector<std::array<Vector2f, 3>> uv(atlas.corners.size());
  for (std::size_t i = 0; i < uv.size(); ++i)
    for (int k = 0; k < 3; ++k)
      uv[i][k] = Vector2f(static_cast<float>((atlas.corners[i][k].x() + 0.5) / atlas.size.width),
                          static_cast<float>((atlas.corners[i][k].y() + 0.5) / atlas.size.height));
  return uv;
}

}  // namespace dressform
