#include "pipeline/fuse/free_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/imaging/depth_map.h"

namespace dressform {
namespace {

// Points of the lattice that lie behind a measured surface, up to `depth_m`: body, whatever lies there.
std::vector<char> supported(const Lattice& lattice, const PointCloud& measured, double depth_m) {
  std::vector<char> result(lattice.count(), 0);
  constexpr double kHalfDiagonal = 0.87;  // of a cell, in steps: no point falls between the columns
  const double reach = kHalfDiagonal * lattice.step_m;
  const auto steps = static_cast<int>(std::ceil(depth_m / lattice.step_m));
  for (std::size_t i = 0; i < measured.points.size(); ++i)
    for (int k = 0; k <= steps; ++k) {
      const Vector3d p = measured.points[i] - (reach + k * lattice.step_m) * measured.normals[i];
      const Vector3d at = ((p - lattice.origin) / lattice.step_m).array().round();
      if ((at.array() < 0).any()) continue;
      const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y()), z = static_cast<int>(at.z());
      if (x < lattice.size[0] && y < lattice.size[1] && z < lattice.size[2]) result[lattice.index(x, y, z)] = 1;
    }
  return result;
}

// Those of the seen-through points that lie within `reach` steps of one that is deep inside.
std::vector<std::size_t> near_deep_ones(const Lattice& lattice, const std::vector<float>& field,
                                        const std::vector<std::size_t>& through, int reach) {
  std::vector<char> close(lattice.count(), 0);
  for (const std::size_t i : through) {
    if (field[i] > -lattice.step_m) continue;
    const auto [x, y, z] = lattice.cell(i);
    for (int w = std::max(0, z - reach); w <= std::min(lattice.size[2] - 1, z + reach); ++w)
      for (int v = std::max(0, y - reach); v <= std::min(lattice.size[1] - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(lattice.size[0] - 1, x + reach); ++u)
          close[lattice.index(u, v, w)] = 1;
  }
  std::vector<std::size_t> result;
  for (const std::size_t i : through)
    if (close[i]) result.push_back(i);
  return result;
}

}  // namespace

std::vector<int> count_free_space_violations(const std::vector<Vector3d>& points, const ScanViews& views,
                                             double margin_m) {
  std::vector<int> counts(points.size(), 0);
  const Projector projector(views.calibration.ir);
  std::vector<Eigen::Isometry3f> frame_from_model;
  std::vector<const cv::Mat*> images;
  for (std::size_t i = 0; i < views.scan.depth_mm.size(); ++i) {
    if (!views.used[i]) continue;
    images.push_back(&views.scan.depth_mm[i]);
    frame_from_model.push_back(views.model_from_frame[i].inverse().cast<float>());
  }
  const auto behind_mm = static_cast<float>(1e3 * (margin_m + views.calibration.depth_offset_m));
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      const Vector3f p = frame_from_model[i] * points[k].cast<float>();
      Vector2f pixel;
      if (!projector(p, pixel)) continue;
      const int u = std::min(images[i]->cols - 1, static_cast<int>(pixel.x() + 0.5f));
      const int v = std::min(images[i]->rows - 1, static_cast<int>(pixel.y() + 0.5f));
      counts[k] += images[i]->at<std::uint16_t>(v, u) > 1e3f * p.z() + behind_mm;
    }
  });
  return counts;
}

Carved carved(const Lattice& lattice, std::vector<float> field, const PointCloud& measured, const ScanViews& views,
              const FreeSpaceOptions& options) {
  constexpr int kReach = 3;  // steps from a place deep inside that what is seen through beside it is taken out
  const std::vector<char> body = supported(lattice, measured, options.support_m);
  std::vector<std::size_t> asked, through;
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (field[i] >= 0 || body[i]) continue;
    asked.push_back(i);
    points.push_back(lattice.point(i));
  }
  const std::vector<int> counts = count_free_space_violations(points, views, options.margin_m);
  for (std::size_t k = 0; k < asked.size(); ++k)
    if (counts[k] >= options.least_views) through.push_back(asked[k]);
  Carved result{std::move(field), 0};
  for (const std::size_t i : near_deep_ones(lattice, result.field, through, kReach)) {
    result.field[i] = static_cast<float>(0.5 * lattice.step_m);
    ++result.points;
  }
  return result;
}

}  // namespace dressform
