#include "synthetic/geometry/contour_grid.h"

#include <tbb/parallel_for_each.h>

#include <cmath>
#include <numeric>
#include <set>

namespace dressform {
namespace {

constexpr int kBlock = ContourGrid::kBlock;

constexpr float kOffSurface = 1e-9f;  // a sample exactly on the surface would have no side

class Sampler {
 public:
  Sampler(const Field& field, const Eigen::AlignedBox3d& box, double step, const Vector3d& shift) : field_(field) {
    grid_.step = step;
    grid_.origin = box.min() - (Vector3d::Constant(2) - shift) * step;
    for (int k = 0; k < 3; ++k) grid_.blocks[k] = static_cast<int>(std::ceil((box.sizes()[k] / step + 4) / kBlock));
    grid_.size = grid_.blocks * kBlock + Vector3i::Ones();
    grid_.values.assign(static_cast<size_t>(grid_.size.x()) * grid_.size.y() * grid_.size.z(), 0.f);
    grid_.sampled.assign(static_cast<size_t>(grid_.blocks.prod()), 0);
  }

  ContourGrid run() {
    std::vector<int> blocks(grid_.blocks.prod());
    std::iota(blocks.begin(), blocks.end(), 0);
    tbb::parallel_for_each(blocks, [this](int block) { sample(block, false); });
    // The field may promise too much distance: wherever the surface leaves the sampled blocks, follow it.
    for (blocks = unsampled_at_surface(); !blocks.empty(); blocks = unsampled_at_surface())
      tbb::parallel_for_each(blocks, [this](int block) { sample(block, true); });
    return std::move(grid_);
  }

 private:
  Vector3i place(int block) const {
    return {block % grid_.blocks.x(), block / grid_.blocks.x() % grid_.blocks.y(),
            block / (grid_.blocks.x() * grid_.blocks.y())};
  }

  // A block holds the samples [8 b, 8 b + 8) of each axis; the last block also holds those at the far side.
  void sample(int block, bool always) {
    const Vector3i b = place(block);
    const Vector3d center = grid_.origin + grid_.step * kBlock * (b.cast<double>() + Vector3d::Constant(0.5));
    const double reach = 0.5 * std::sqrt(3.0) * (kBlock + 1) * grid_.step;
    const double middle = field_(center);
    const bool near = always || std::abs(middle) < 2 * reach;
    grid_.sampled[block] = near;
    Vector3i end = (b + Vector3i::Ones()) * kBlock;
    for (int k = 0; k < 3; ++k) end[k] += b[k] == grid_.blocks[k] - 1;
    for (int z = b.z() * kBlock; z < end.z(); ++z)
      for (int y = b.y() * kBlock; y < end.y(); ++y)
        for (int x = b.x() * kBlock; x < end.x(); ++x) {
          const double value = near ? field_(grid_.point(x, y, z)) : middle;
          grid_.values[grid_.at(x, y, z)] = value == 0 ? kOffSurface : static_cast<float>(value);
        }
  }

  bool crossed(int x, int y, int z) const {
    const bool inside = grid_.values[grid_.at(x, y, z)] < 0;
    for (int i = 1; i < 8; ++i)
      if ((grid_.values[grid_.at(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2))] < 0) != inside) return true;
    return false;
  }

  // Blocks next to a crossed cell at the rim of a sampled block.
  std::vector<int> unsampled_at_surface() const {
    std::set<int> found;
    for (int block = 0; block < grid_.blocks.prod(); ++block) {
      if (!grid_.sampled[block]) continue;
      const Vector3i b = place(block);
      for (int i = 0; i < kBlock * kBlock * kBlock; ++i) {
        const Vector3i local(i % kBlock, i / kBlock % kBlock, i / (kBlock * kBlock));
        if (local.minCoeff() > 0 && local.maxCoeff() < kBlock - 1) continue;
        const Vector3i cell = b * kBlock + local;
        if (!crossed(cell.x(), cell.y(), cell.z())) continue;
        for (int n = 0; n < 27; ++n) add_neighbour(b, local, Vector3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1), found);
      }
    }
    return {found.begin(), found.end()};
  }

  void add_neighbour(const Vector3i& b, const Vector3i& local, const Vector3i& side, std::set<int>& found) const {
    for (int k = 0; k < 3; ++k) {
      if (side[k] < 0 && local[k] > 0) return;
      if (side[k] > 0 && local[k] < kBlock - 1) return;
      if (b[k] + side[k] < 0 || b[k] + side[k] >= grid_.blocks[k]) return;
    }
    const Vector3i n = b + side;
    const int index = (n.z() * grid_.blocks.y() + n.y()) * grid_.blocks.x() + n.x();
    if (!grid_.sampled[index]) found.insert(index);
  }

  const Field& field_;
  ContourGrid grid_;
};

}  // namespace

ContourGrid sample_near_surface(const Field& field, const Eigen::AlignedBox3d& box, double step_m,
                                const Vector3d& shift) {
  return Sampler(field, box, step_m, shift).run();
}

}  // namespace dressform
