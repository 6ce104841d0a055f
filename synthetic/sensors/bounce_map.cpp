#include "synthetic/sensors/bounce_map.h"

#include <algorithm>
#include <cmath>

#include "synthetic/sensors/tof_bounce.h"

namespace dressform {
namespace {

constexpr int cell = 8;    // pixels between the points that gather
constexpr int patch = 32;  // pixels along the edge of a patch that sends on

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

tof::LitPatches patches_of(const IrView& view, const GridHits& hits, double falloff, double strength) {
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
    const double angle = patch * patch / (view.camera().fx * view.camera().fy * std::pow(stretch2, 1.5));
    const double profile = std::pow(stretch2, 0.5 * (4 - falloff));
    patches.weight[i] = static_cast<float>(strength * packet.nir_albedo[lane] / M_PI * profile * angle);
    patches.area_m2[i] = static_cast<float>(angle * z * z * stretch2);
  }
  return patches;
}

}  // namespace

BounceMap::BounceMap(const IrView& view, double falloff, double strength) : width_(view.width()) {
  if (strength <= 0) return;
  columns_ = (view.width() - 1) / cell + 2;
  rows_ = (view.height() - 1) / cell + 2;
  const GridHits sources = trace_grid(view, (view.width() + patch - 1) / patch, (view.height() + patch - 1) / patch,
                                      0.5f * (patch - 1), patch);
  const tof::LitPatches patches = patches_of(view, sources, falloff, strength);
  const tof::SurfacePoints points = points_of(trace_grid(view, columns_, rows_, 0, cell));
  grid_.resize(static_cast<std::size_t>(rows_) * tof::bounce_terms * columns_);
  tbb::parallel_for(0, rows_, [&](int row) {
    float* terms[tof::bounce_terms];
    for (int t = 0; t < tof::bounce_terms; ++t)
      terms[t] = &grid_[(static_cast<std::size_t>(row) * tof::bounce_terms + t) * columns_];
    tof::gather_bounce(patches, points, row * columns_, columns_, terms);
  });
}

void BounceMap::row(int y, float* terms) const {
  if (grid_.empty()) {
    std::fill(terms, terms + static_cast<std::ptrdiff_t>(tof::bounce_terms) * width_, 0.0f);
    return;
  }
  const std::ptrdiff_t above = static_cast<std::ptrdiff_t>(y / cell) * tof::bounce_terms * columns_;
  const float down = static_cast<float>(y % cell) / cell;
  for (int t = 0; t < tof::bounce_terms; ++t) {
    const float* upper = &grid_[above + static_cast<std::ptrdiff_t>(t) * columns_];
    const float* lower = upper + static_cast<std::ptrdiff_t>(tof::bounce_terms) * columns_;
    float* out = terms + static_cast<std::ptrdiff_t>(t) * width_;
    for (int column = 0; column + 1 < columns_; ++column) {
      const float left = (1 - down) * upper[column] + down * lower[column];
      const float right = (1 - down) * upper[column + 1] + down * lower[column + 1];
      const int end = std::min(cell, width_ - column * cell);
      for (int i = 0; i < end; ++i) out[column * cell + i] = left + (right - left) * (static_cast<float>(i) / cell);
    }
  }
}

}  // namespace dressform
