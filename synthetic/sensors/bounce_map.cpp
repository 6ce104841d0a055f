#include "synthetic/sensors/bounce_map.h"

#include <algorithm>
#include <cmath>

#include "synthetic/sensors/tof_bounce.h"

namespace dressform {
namespace {

// Pixels between the points that gather, and along the edge of a patch that sends on: 5 cm at 2 m, coarser ones lose
// what is near, whatever the resolution of the image.
int edge_px(int width) { return std::max(4, (width + 32) / 64); }
constexpr float one_surface = 0.05f;  // largest step in depth within a cell of one surface, in parts of the depth

// Hits at a grid of pixels, row by row.
struct GridHits {
  int columns, rows;
  std::vector<IrPacket> packets;
  const IrPacket& packet(int index) const { return packets[index / packet_size]; }
};

GridHits trace_grid(const IrView& view, int columns, int rows, float first, float step) {
  GridHits hits{columns, rows, std::vector<IrPacket>((columns * rows + packet_size - 1) / packet_size)};
  tbb::parallel_for(0, static_cast<int>(hits.packets.size()), [&](int i) {
    Vector2f pixels[packet_size];
    const int count = std::min(packet_size, columns * rows - i * packet_size);
    for (int lane = 0; lane < count; ++lane) {
      const int index = i * packet_size + lane;
      pixels[lane] = {std::min(first + step * (index % columns), static_cast<float>(view.width())),
                      std::min(first + step * (index / columns), static_cast<float>(view.height()))};
    }
    view.trace(pixels, count, hits.packets[i]);
  });
  return hits;
}

tof::SurfacePoints points_of(const GridHits& hits) {
  tof::SurfacePoints points;
  const int count = hits.columns * hits.rows;
  points.resize(count);
  for (int i = 0; i < count; ++i) {
    const IrPacket& packet = hits.packet(i);
    const int lane = i % packet_size;
    const float z = packet.depth_m[lane], emitter_m = 0.001f * tof::emitter_x_mm;
    points.x[i] = z * packet.ideal_x[lane], points.y[i] = z * packet.ideal_y[lane], points.z[i] = z;
    points.normal_x[i] = packet.normal_x[lane], points.normal_y[i] = packet.normal_y[lane];
    points.normal_z[i] = packet.normal_z[lane];
    points.from_emitter_m[i] = Vector3f(points.x[i] - emitter_m, points.y[i], z).norm();
  }
  return points;
}

tof::LitPatches patches_of(const IrView& view, const GridHits& hits, int patch, double falloff, double strength) {
  tof::LitPatches patches{points_of(hits), {}, {}};
  const int count = hits.columns * hits.rows;
  patches.weight.assign(count, 0.0f);
  patches.area_m2.assign(count, 0.0f);
  for (int i = 0; i < count; ++i) {
    const IrPacket& packet = hits.packet(i);
    const int lane = i % packet_size;
    const float z = packet.depth_m[lane];
    if (z <= 0 || packet.chrome[lane]) continue;
    const double stretch2 =
        1 + packet.ideal_x[lane] * packet.ideal_x[lane] + packet.ideal_y[lane] * packet.ideal_y[lane];
    const int across = std::min(patch, view.width() - i % hits.columns * patch);  // less at the image's border
    const int down = std::min(patch, view.height() - i / hits.columns * patch);
    const double angle = across * down / (view.camera().fx * view.camera().fy * std::pow(stretch2, 1.5));
    const double profile = std::pow(stretch2, 0.5 * (4 - falloff));
    patches.weight[i] = static_cast<float>(strength * packet.nir_albedo[lane] / M_PI * profile * angle);
    patches.area_m2[i] = static_cast<float>(angle * z * z * stretch2);
  }
  return patches;
}

}  // namespace

BounceMap::BounceMap(const IrView& view, double falloff, double strength)
    : width_(view.width()), edge_(edge_px(view.width())) {
  if (strength <= 0) return;
  columns_ = (view.width() - 1) / edge_ + 2;
  rows_ = (view.height() - 1) / edge_ + 2;
  const GridHits sources = trace_grid(view, (view.width() + edge_ - 1) / edge_, (view.height() + edge_ - 1) / edge_,
                                      0.5f * (edge_ - 1), edge_);
  const tof::LitPatches patches = patches_of(view, sources, edge_, falloff, strength);
  const tof::SurfacePoints points = points_of(trace_grid(view, columns_, rows_, 0, edge_));
  depth_m_ = points.z;
  grid_.resize(static_cast<std::size_t>(rows_) * tof::bounce_terms * columns_);
  tbb::parallel_for(0, rows_, [&](int row) {
    float* terms[tof::bounce_terms];
    for (int t = 0; t < tof::bounce_terms; ++t)
      terms[t] = &grid_[(static_cast<std::size_t>(row) * tof::bounce_terms + t) * columns_];
    tof::gather_bounce(patches, points, row * columns_, columns_, terms);
  });
}

void BounceMap::row(int y, const float* depth_m, float* terms) const {
  if (grid_.empty()) {
    std::fill(terms, terms + static_cast<std::ptrdiff_t>(tof::bounce_terms) * width_, 0.0f);
    return;
  }
  const float down = static_cast<float>(y % edge_) / edge_;
  for (int column = 0; column + 1 < columns_; ++column) {
    const int first = column * edge_, end = std::min(edge_, width_ - first);
    const int corner = (y / edge_) * columns_ + column;
    const float depths[4] = {depth_m_[corner], depth_m_[corner + 1], depth_m_[corner + columns_],
                             depth_m_[corner + columns_ + 1]};
    const auto [least, most] = std::minmax_element(depths, depths + 4);
    const bool whole = *most - *least <= one_surface * *least;
    for (int i = 0; i < end; ++i) {
      const float right = static_cast<float>(i) / edge_;
      float weights[4] = {(1 - right) * (1 - down), right * (1 - down), (1 - right) * down, right * down};
      if (!whole) keep_one_surface(depths, depth_m[first + i], weights);
      mix(corner, weights, &terms[first + i]);
    }
  }
}

// Corners on another surface have other light: only those near the pixel's depth count, or the nearest in depth.
void BounceMap::keep_one_surface(const float (&depths)[4], float depth_m, float (&weights)[4]) {
  float sum = 0;
  int nearest = 0;
  for (int c = 0; c < 4; ++c) {
    if (std::abs(depths[c] - depth_m) < std::abs(depths[nearest] - depth_m)) nearest = c;
    if (std::abs(depths[c] - depth_m) > one_surface * depth_m) weights[c] = 0;
    sum += weights[c];
  }
  if (sum > 0.01f) {
    for (float& weight : weights) weight /= sum;
  } else {
    for (int c = 0; c < 4; ++c) weights[c] = c == nearest ? 1.0f : 0.0f;
  }
}

void BounceMap::mix(int corner, const float (&weights)[4], float* terms) const {
  const int row = corner / columns_, column = corner % columns_;
  const float* upper = &grid_[static_cast<std::size_t>(row) * tof::bounce_terms * columns_ + column];
  const float* lower = upper + static_cast<std::ptrdiff_t>(tof::bounce_terms) * columns_;
  for (int t = 0; t < tof::bounce_terms; ++t) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(t) * columns_;
    terms[static_cast<std::ptrdiff_t>(t) * width_] =
        weights[0] * upper[at] + weights[1] * upper[at + 1] + weights[2] * lower[at] + weights[3] * lower[at + 1];
  }
}

}  // namespace dressform
