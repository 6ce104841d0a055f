#include "pipeline/surface/layer_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dressform {
namespace {

std::vector<float> distances(const Lattice& lattice, const CoveredBody& body) {
  std::vector<float> result(lattice.count());
  tbb::parallel_for(0, lattice.size[2], [&](int z) {
    for (int y = 0; y < lattice.size[1]; ++y)
      for (int x = 0; x < lattice.size[0]; ++x)
        result[lattice.index(x, y, z)] = static_cast<float>(body.signed_distance(lattice.point(x, y, z)));
  });
  return result;
}

double interpolated(const Lattice& lattice, const std::vector<float>& values, const Vector3d& point) {
  const Vector3d at = (point - lattice.origin) / lattice.step_m;
  int base[3];
  double part[3];
  for (int k = 0; k < 3; ++k) {
    base[k] = std::clamp(static_cast<int>(std::floor(at[k])), 0, lattice.size[k] - 2);
    part[k] = std::clamp(at[k] - base[k], 0.0, 1.0);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double w = 1;
    for (int k = 0; k < 3; ++k) w *= corner >> k & 1 ? part[k] : 1 - part[k];
    sum += w * values[lattice.index(base[0] + (corner & 1), base[1] + (corner >> 1 & 1), base[2] + (corner >> 2 & 1))];
  }
  return sum;
}

}  // namespace

LayerSpace make_space(const CoveredBody& body, const PointCloud& cloud, double step_m, double reach_m) {
  Vector3d low = body.low(), high = body.high();
  for (const Vector3d& p : cloud.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  LayerSpace space;
  space.lattice = make_lattice(low, high, reach_m + 4 * step_m, step_m);
  double farthest = 0;
  for (const Vector3d& p : cloud.points) farthest = std::max(farthest, body.signed_distance(p));
  const double limit = farthest + reach_m + 2 * step_m;

  const Lattice coarse = make_lattice(low, high, reach_m + 8 * step_m, 4 * step_m);
  const std::vector<float> rough = distances(coarse, body);
  const double slack = std::sqrt(3.0) * coarse.step_m;
  space.body_distance.resize(space.lattice.count());
  space.domain.resize(space.lattice.count());
  tbb::parallel_for(0, space.lattice.size[2], [&](int z) {
    for (int y = 0; y < space.lattice.size[1]; ++y) {
      double bound = std::numeric_limits<double>::infinity();  // the neighbour's distance and a step
      for (int x = 0; x < space.lattice.size[0]; ++x) {
        const Vector3d point = space.lattice.point(x, y, z);
        double distance = interpolated(coarse, rough, point);
        if (distance < limit + slack && distance > -reach_m - slack) {
          distance = body.signed_distance(point, bound);
          bound = std::abs(distance) + 1.001 * step_m;
        } else {
          bound = std::numeric_limits<double>::infinity();
        }
        const std::size_t at = space.lattice.index(x, y, z);
        space.body_distance[at] = static_cast<float>(distance);
        space.domain[at] = distance < limit && distance > -reach_m - 2 * step_m;
      }
    }
  });
  return space;
}

}  // namespace dressform
