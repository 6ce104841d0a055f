#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "synthetic/capture/shapes.h"
#include "synthetic/sensors/sensor_model.h"
#include "synthetic/sensors/tof_decode.h"

namespace dressform {
namespace {

Camera kinect() { return Camera{512, 424, 366, 366, 256, 208, {0.09, -0.27, 0, 0, 0.1}}; }

std::vector<RaySurface> stage() {
  std::vector<RaySurface> surfaces(2);
  surfaces[0].mesh = sphere_mesh({0, 0, 2}, 0.6, 320);  // 400k triangles
  surfaces[1].mesh = grid_mesh({-6, 6, 4}, {12, 0, 0}, {0, -12, 0}, 0.2);
  return surfaces;
}

void report_rate(benchmark::State& state, double rays_per_iteration) {
  state.counters["Mpixel/s"] =
      benchmark::Counter(rays_per_iteration * state.iterations() * 1e-6, benchmark::Counter::kIsRate);
}

// The bare loop over 4 x 4 packets: what the ray caster alone could give, one thread, directions ready-made.
void BareEmbree(benchmark::State& state) {
  const Camera camera = kinect();
  const RayTable table(camera);
  const RTCDevice device = rtcNewDevice(nullptr);
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  for (const auto& surface : stage()) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 12, surface.mesh.vertices.size()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   12, surface.mesh.triangles.size()));
    for (const auto& v : surface.mesh.vertices)
      for (int c = 0; c < 3; ++c) *vertices++ = static_cast<float>(v[c]);
    for (const auto& t : surface.mesh.triangles)
      for (int c = 0; c < 3; ++c) *indices++ = static_cast<unsigned>(t[c]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene);
  alignas(64) int valid[16];
  std::fill(valid, valid + 16, -1);
  for (auto _ : state)
    for (int top = 0; top < 424; top += 4)
      for (int left = 0; left < 512; left += 4) {
        RTCRayHit16 query;
        std::memset(&query, 0, sizeof query);
        for (int i = 0; i < 16; ++i) {
          const Vector2f& ideal = table.at(left + i % 4, top + i / 4);
          query.ray.dir_x[i] = ideal.x(), query.ray.dir_y[i] = ideal.y(), query.ray.dir_z[i] = 1;
          query.ray.tfar[i] = 30, query.ray.mask[i] = ~0u;
          query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect16(valid, scene, &context, &query);
        benchmark::DoNotOptimize(query);
      }
  report_rate(state, 512 * 424);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
BENCHMARK(BareEmbree)->Unit(benchmark::kMillisecond)->UseRealTime();

// What the sensor models ask for: depth, normal and albedo of every pixel, in packets. The ratio of its rate to the
// bare loop's is what the house leaves of the ray caster.
void DepthRays(benchmark::State& state) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, state.range(0));
  const RayScene scene(stage());
  const Camera camera = kinect();
  const RayTable table(camera);
  const IrView view(scene, table, camera, Isometry3d::Identity(), 0);
  for (auto _ : state) view.for_each_block([](int, int, const IrPacket& packet) { benchmark::DoNotOptimize(packet); });
  report_rate(state, 512 * 424);
}
BENCHMARK(DepthRays)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void Measure(benchmark::State& state, const char* model) {
  const RayScene scene(stage());
  const Camera camera = kinect();
  const RayTable table(camera);
  const IrView view(scene, table, camera, Isometry3d::Identity(), 0, false);
  Seed seed = 0;
  for (auto _ : state) benchmark::DoNotOptimize(SensorModel::at(model).run(view, {}, ++seed));
  report_rate(state, 512 * 424);
}
BENCHMARK_CAPTURE(Measure, ideal, "ideal")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(Measure, fankhauser, "fankhauser")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(Measure, kinect_v2, "kinect_v2")->Unit(benchmark::kMillisecond)->UseRealTime();

// The driver's half alone: a frame of phasors, one thread.
void Decode(benchmark::State& state) {
  constexpr int width = 512, height = 424;
  std::vector<float> phasors(static_cast<std::size_t>(9) * width * height), out(9 * width), ideal(width, 0.1f);
  for (std::size_t i = 0; i < phasors.size(); ++i) phasors[i] = i / (width * height) % 3 == 2 ? 50.0f : 0.707f;
  const auto row = [&](int y) {
    tof::PhasorRows::Row result;
    for (int f = 0; f < tof::frequencies; ++f) {
      const auto plane = [&](int p) {
        return &phasors[(static_cast<std::size_t>(3 * f + p) * height + std::clamp(y, 0, height - 1)) * width];
      };
      result.cosine[f] = plane(0), result.sine[f] = plane(1), result.amplitude[f] = plane(2);
    }
    return result;
  };
  const auto part = [&](int i) { return &out[static_cast<std::size_t>(i) * width]; };
  const tof::FilteredRow filtered{{part(0), part(1), part(2)}, {part(3), part(4), part(5)}, part(6)};
  for (auto _ : state)
    for (int y = 0; y < height; ++y) {
      const tof::PhasorRows rows{row(y - 1), row(y), row(y + 1)};
      tof::bilateral(rows, width, filtered);
      tof::unwrap(filtered, rows, ideal.data(), ideal.data(), width, part(7), part(8));
      benchmark::DoNotOptimize(out.data());
      benchmark::ClobberMemory();
    }
  report_rate(state, width * height);
}
BENCHMARK(Decode)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace dressform
