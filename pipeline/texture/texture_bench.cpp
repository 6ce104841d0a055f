#include <benchmark/benchmark.h>

#include "pipeline/texture/textured_tube.h"

namespace dressform {
namespace {

cv::Vec3f checks(double turn, double height) {
  const bool odd = (static_cast<int>(std::floor(turn * 4)) + static_cast<int>(std::floor(height * 20))) & 1;
  return odd ? cv::Vec3f(60, 70, 180) : cv::Vec3f(190, 170, 150);
}

// Argument: percent of the full image size.
void texture(benchmark::State& state, const char* variant) {
  const TubeScene scene = tube_scene(checks, state.range(0) / 100.0);
  for (auto _ : state)
    benchmark::DoNotOptimize(Texture::at(variant).run(scene.session, scene.calibration, scene.naked, scene.registration,
                                                      scene.filled, scene.opened, {}, 1));
}
BENCHMARK_CAPTURE(texture, levelled, "levelled")->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(texture, best_view, "best_view")->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace dressform
