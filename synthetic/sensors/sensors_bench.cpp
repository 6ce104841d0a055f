#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <tbb/global_control.h>

#include <cstring>

#include "synthetic/capture/shapes.h"
#include "synthetic/sensors/sensor_model.h"

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
  state.counters["Mray/s"] =
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

// First hits with normals and albedo, on the given number of threads.
void FirstHits(benchmark::State& state) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, state.range(0));
  const RayScene scene(stage());
  const Camera camera = kinect();
  const RayTable table(camera);
  const IrView view(scene, table, camera, Isometry3d::Identity(), 0);
  for (auto _ : state) benchmark::DoNotOptimize(view.first_hits());
  report_rate(state, 512 * 424);
}
BENCHMARK(FirstHits)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

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

}  // namespace
}  // namespace dressform
