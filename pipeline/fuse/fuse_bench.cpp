#include <benchmark/benchmark.h>

#include "pipeline/fuse/align_frames.h"
#include "pipeline/fuse/block_volume.h"
#include "pipeline/testing/test_scene.h"

namespace dressform {
namespace {

struct Prepared {
  SensorCalibration calibration = test_scene::kinect(1.0);
  test_scene::Scan scan = test_scene::walk_round(test_scene::standing_figure(), calibration, 12, 36, 1, 7);
  ScanFrames frames = prepare_frames(scan.scan, calibration, 30, 4.5);
  Projector projector{frames.first_usable().camera};
};
const Prepared& prepared() {
  static const Prepared instance;
  return instance;
}

// One 512 x 424 depth image to points with normals.
void prepare_a_frame(benchmark::State& state) {
  const Prepared& data = prepared();
  DepthScan one;
  one.depth_mm = {data.scan.scan.depth_mm[0]};
  for (auto _ : state) benchmark::DoNotOptimize(prepare_frames(one, data.calibration, 30, 4.5));
}
BENCHMARK(prepare_a_frame)->Unit(benchmark::kMillisecond);

// Normal equations of one pair of frames: one projective point-to-plane step.
void pair_of_frames(benchmark::State& state) {
  const Prepared& data = prepared();
  const auto& frames = data.frames;
  for (auto _ : state)
    benchmark::DoNotOptimize(pair_equations(frames.maps[0], frames.samples[0], frames.maps[1], data.projector,
                                            data.scan.world_from_sensor[0], data.scan.world_from_sensor[1], {}));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(frames.samples[0].size()));
}
BENCHMARK(pair_of_frames)->Unit(benchmark::kMicrosecond);

// Twelve frames of 512 x 424 into the volume round the body; the argument is the voxel in millimetres.
void fill_volume(benchmark::State& state) {
  const Prepared& data = prepared();
  VolumeOptions options;
  options.voxel_m = 1e-3 * static_cast<double>(state.range(0));
  const std::vector<char> used(data.frames.count(), 1);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        BlockVolume(data.frames, data.calibration.ir, data.scan.world_from_sensor, used, {}, options));
  state.SetItemsProcessed(state.iterations() * data.frames.count());
}
BENCHMARK(fill_volume)->Arg(3)->Arg(4)->Arg(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dressform
