// Fitting and evaluating the map of space at the sizes of one garment and of one body.
#include <benchmark/benchmark.h>

#include "pipeline/fit/rbf_field.h"
#include "scenes/random.h"

namespace dressform {
namespace {

std::vector<Vector3d> points(int count, std::uint64_t stream) {
  std::vector<Vector3d> result;
  for (int i = 0; i < count; ++i) {
    const auto u = uniform4(1, stream, i);
    result.emplace_back(u[0], 1.8 * u[1], 0.4 * u[2]);
  }
  return result;
}

RbfField field(int controls) {
  auto targets = points(controls, 1);
  for (int i = 0; i < controls; ++i)
    targets[i] += 0.02 * Vector3d(uniform(1, 2, i), uniform(1, 3, i), uniform(1, 4, i));
  return RbfField(points(controls, 1), targets, RbfField::Kernel::linear, 0.02);
}

void solve(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(field(static_cast<int>(state.range(0))));
}
BENCHMARK(solve)->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);

void evaluate(benchmark::State& state) {
  const RbfField map = field(1000);
  const auto cloth = points(static_cast<int>(state.range(0)), 5);
  for (auto _ : state) benchmark::DoNotOptimize(map(cloth));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(evaluate)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace dressform
