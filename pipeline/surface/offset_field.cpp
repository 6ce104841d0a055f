#include "pipeline/surface/offset_field.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr float kOverRelaxation = 1.5f;
constexpr int kSmallest = 10;  // lattices with a side shorter than this are not coarsened further

struct Problem {
  Lattice lattice;
  LatticeData data;
  std::vector<std::uint8_t> domain;
  float stiffness = 1;  // per lattice of this step
};

// Eight points become one: weights are summed, values averaged by weight.
Problem coarsened(const Problem& fine) {
  Problem coarse;
  coarse.lattice.origin = fine.lattice.origin + Vector3d::Constant(fine.lattice.step_m / 2);
  coarse.lattice.step_m = 2 * fine.lattice.step_m;
  for (int k = 0; k < 3; ++k) coarse.lattice.size[k] = (fine.lattice.size[k] + 1) / 2;
  coarse.stiffness = fine.stiffness / 2;  // sum of 8 weights against differences that count 2-fold
  coarse.data.value.assign(coarse.lattice.count(), 0);
  coarse.data.weight.assign(coarse.lattice.count(), 0);
  coarse.domain.assign(coarse.lattice.count(), 0);
  for (int z = 0; z < fine.lattice.size[2]; ++z)
    for (int y = 0; y < fine.lattice.size[1]; ++y)
      for (int x = 0; x < fine.lattice.size[0]; ++x) {
        const std::size_t from = fine.lattice.index(x, y, z), to = coarse.lattice.index(x / 2, y / 2, z / 2);
        if (!fine.domain[from]) continue;
        coarse.domain[to] = 1;
        coarse.data.value[to] += fine.data.weight[from] * fine.data.value[from];
        coarse.data.weight[to] += fine.data.weight[from];
      }
  for (std::size_t i = 0; i < coarse.domain.size(); ++i)
    if (coarse.data.weight[i] > 0) coarse.data.value[i] /= coarse.data.weight[i];
  return coarse;
}

void relax_row(const Problem& problem, std::vector<float>& field, int y, int z, int first_x) {
  const Lattice& l = problem.lattice;
  const std::ptrdiff_t dy = l.size[0], dz = static_cast<std::ptrdiff_t>(l.size[0]) * l.size[1];
  for (int x = first_x; x < l.size[0]; x += 2) {
    const std::size_t at = l.index(x, y, z);
    if (!problem.domain[at]) continue;
    float sum = 0, count = 0;
    const auto add = [&](bool exists, std::ptrdiff_t step) {
      if (!exists || !problem.domain[at + step]) return;
      sum += field[at + step];
      count += 1;
    };
    add(x > 0, -1);
    add(x + 1 < l.size[0], 1);
    add(y > 0, -dy);
    add(y + 1 < l.size[1], dy);
    add(z > 0, -dz);
    add(z + 1 < l.size[2], dz);
    const float w = problem.stiffness * problem.data.weight[at];
    if (count + w <= 0) continue;
    const float target = (sum + w * problem.data.value[at]) / (count + w);
    field[at] += kOverRelaxation * (target - field[at]);
  }
}

void relax(const Problem& problem, std::vector<float>& field, int sweeps) {
  for (int sweep = 0; sweep < 2 * sweeps; ++sweep)
    tbb::parallel_for(tbb::blocked_range<int>(0, problem.lattice.size[2], 4), [&](const auto& range) {
      for (int z = range.begin(); z < range.end(); ++z)
        for (int y = 0; y < problem.lattice.size[1]; ++y) relax_row(problem, field, y, z, (sweep + y + z) % 2);
    });
}

std::vector<float> prolonged(const Problem& coarse, const std::vector<float>& values, const Problem& fine) {
  std::vector<float> field(fine.lattice.count(), 0);
  const Lattice& c = coarse.lattice;
  tbb::parallel_for(0, fine.lattice.size[2], [&](int z) {
    for (int y = 0; y < fine.lattice.size[1]; ++y)
      for (int x = 0; x < fine.lattice.size[0]; ++x) {
        const std::size_t at = fine.lattice.index(x, y, z);
        if (!fine.domain[at]) continue;
        float sum = 0, weight = 0;
        const int base[3] = {x / 2, y / 2, z / 2}, side[3] = {x % 2 ? 1 : -1, y % 2 ? 1 : -1, z % 2 ? 1 : -1};
        for (int corner = 0; corner < 8; ++corner) {
          int p[3];
          float w = 1;
          bool inside = true;
          for (int k = 0; k < 3; ++k) {
            const bool other = corner >> k & 1;
            p[k] = base[k] + (other ? side[k] : 0);
            w *= other ? 0.25f : 0.75f;
            inside &= p[k] >= 0 && p[k] < c.size[k];
          }
          if (!inside || !coarse.domain[c.index(p[0], p[1], p[2])]) continue;
          sum += w * values[c.index(p[0], p[1], p[2])];
          weight += w;
        }
        field[at] = weight > 0 ? sum / weight : 0;
      }
  });
  return field;
}

std::vector<float> solve(const Problem& problem, int sweeps) {
  const int least = std::min({problem.lattice.size[0], problem.lattice.size[1], problem.lattice.size[2]});
  if (least < kSmallest) {
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < problem.domain.size(); ++i) {
      sum += problem.data.weight[i] * problem.data.value[i];
      weight += problem.data.weight[i];
    }
    std::vector<float> field(problem.lattice.count(), weight > 0 ? static_cast<float>(sum / weight) : 0.0f);
    relax(problem, field, 4 * sweeps);
    return field;
  }
  const Problem coarse = coarsened(problem);
  std::vector<float> field = prolonged(coarse, solve(coarse, sweeps), problem);
  relax(problem, field, sweeps);
  return field;
}

}  // namespace

LatticeData plane_distances(const Lattice& lattice, const GarmentCloud& cloud, double sigma_m, double reach_m) {
  std::vector<float> sum(lattice.count(), 0), weights(lattice.count(), 0);
  const double tangential_reach = 2.5 * sigma_m, reach = std::max(tangential_reach, reach_m);
  const double along_sigma = reach_m / 2;
  for (std::size_t i = 0; i < cloud.cloud.points.size(); ++i) {
    const Vector3d &p = cloud.cloud.points[i], &n = cloud.cloud.normals[i];
    int from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = std::max(0, static_cast<int>(std::ceil((p[k] - reach - lattice.origin[k]) / lattice.step_m)));
      to[k] = std::min(lattice.size[k] - 1,
                       static_cast<int>(std::floor((p[k] + reach - lattice.origin[k]) / lattice.step_m)));
    }
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) {
          const Vector3d d = lattice.point(x, y, z) - p;
          const double along = n.dot(d), across = d.squaredNorm() - along * along;
          if (std::abs(along) > reach_m || across > tangential_reach * tangential_reach) continue;
          const double w = cloud.weights[i] * std::exp(-0.5 * across / (sigma_m * sigma_m) -
                                                       0.5 * along * along / (along_sigma * along_sigma));
          const std::size_t at = lattice.index(x, y, z);
          sum[at] += static_cast<float>(w * along);
          weights[at] += static_cast<float>(w);
        }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (weights[i] <= 1e-4f) weights[i] = 0;
    sum[i] = weights[i] > 0 ? sum[i] / weights[i] : 0;
    weights[i] = std::min(1.0f, weights[i]);
  }
  return {std::move(sum), std::move(weights)};
}

std::vector<float> diffuse(const Lattice& lattice, const LatticeData& data, const std::vector<std::uint8_t>& domain,
                           double stiffness, int sweeps, const std::vector<float>& start) {
  Problem problem{lattice, data, domain, static_cast<float>(stiffness)};
  for (std::size_t i = 0; i < domain.size(); ++i)
    if (!domain[i]) problem.data.weight[i] = 0;
  if (start.empty()) return solve(problem, sweeps);
  std::vector<float> field = start;
  relax(problem, field, sweeps);
  return field;
}

}  // namespace dressform
