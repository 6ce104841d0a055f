#include <benchmark/benchmark.h>

#include "eval/metrics/mesh_distance.h"
#include "eval/metrics/sampling.h"
#include "eval/metrics/surface_metrics.h"
#include "eval/testing/test_meshes.h"

namespace dressform::metrics {
namespace {

// A body-sized tube of about `triangles` triangles, and one slightly larger to measure from.
Mesh wall(int triangles, double radius) {
  const int sectors = static_cast<int>(std::sqrt(triangles / 2.0));
  return test_meshes::tube(radius, 0.7 * radius, {0, 0, 0}, 0, 1.8, sectors, sectors, false);
}

void nearest_of_250k_points(benchmark::State& state) {
  const MeshDistance distance(wall(static_cast<int>(state.range(0)), 0.2));
  auto points = sample_surface(wall(40000, 0.205), 0.0026, 1).points;
  for (auto _ : state) benchmark::DoNotOptimize(distance.nearest(points));
  state.counters["points/s"] =
      benchmark::Counter(static_cast<double>(points.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(nearest_of_250k_points)->Arg(40000)->Arg(400000)->Unit(benchmark::kMillisecond)->UseRealTime();

void compare_garment(benchmark::State& state) {
  const Mesh estimate = wall(60000, 0.205), truth = wall(60000, 0.2);
  for (auto _ : state) benchmark::DoNotOptimize(compare_surfaces(estimate, truth));
}
BENCHMARK(compare_garment)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace dressform::metrics
