#include <benchmark/benchmark.h>

#include "pipeline/geometry/poisson.h"
#include "pipeline/registration/model_alignment.h"
#include "pipeline/testing/test_scene.h"

namespace dressform {
namespace {

struct Prepared {
  BodyModel naked;
  std::vector<ViewPoints> views;
  Isometry3d model_from_sensor;
};

// One view at full size and a model of about 40 000 vertices.
Prepared prepare() {
  const test_scene::Figure figure = test_scene::standing_figure();
  Prepared data;
  PointCloud cloud;
  for (std::uint64_t i = 0; i < 200000; ++i) {  // rays towards the axis from all sides
    const auto u = uniform4(1, 2, i);
    const Vector3d out(std::sin(2 * M_PI * u[0]), 2 * u[2] - 1, std::cos(2 * M_PI * u[0]));
    const Vector3d from = Vector3d(0.3 * (u[3] - 0.5), 1.8 * u[1], 0) + 2 * out;
    test_scene::Figure body = figure;
    body.floor = false;
    body.wall_m = 0;
    const auto hit = test_scene::cast(body, from, -out);
    if (!hit.body) continue;
    cloud.points.push_back(from - hit.distance * out);
    cloud.normals.push_back(hit.normal);
  }
  data.naked.body = poisson_surface(cloud, 8);
  const SensorCalibration calibration = test_scene::kinect(1.0);
  data.model_from_sensor = test_scene::looking_at({0, 1.25, 2.1}, {0, 0.95, 0});
  CaptureSession session;
  session.sensors = {"k1"};
  session.naked["k1"].depth_mm =
      test_scene::depth_image(figure, calibration, normalized_grid(calibration.ir), data.model_from_sensor, 1, 3);
  Calibration sensors;
  sensors.sensors["k1"] = calibration;
  data.views = view_points(session, sensors, {}, 1 << 30);
  return data;
}
const Prepared& prepared() {
  static const Prepared instance = prepare();
  return instance;
}

// One point-to-plane step of one view; the argument is the number of points of the body.
void model_step(benchmark::State& state) {
  const Prepared& data = prepared();
  const ModelTarget target(data.naked);
  const ModelGate gate{0.015, 0.7, static_cast<int>(state.range(0))};
  int points = 0;
  for (auto _ : state) points = model_equations(data.views[0], target, data.model_from_sensor, gate).points;
  state.SetItemsProcessed(state.iterations() * points);
}
BENCHMARK(model_step)->Arg(2000)->Arg(8000)->Unit(benchmark::kMillisecond);

// The whole descent of one view from 5 degrees and 38 mm off.
void align_a_view(benchmark::State& state) {
  const Prepared& data = prepared();
  const ModelTarget target(data.naked);
  Isometry3d off(Eigen::AngleAxisd(5 * M_PI / 180, Vector3d(1, 2, 3).normalized()));
  off.translation() = Vector3d(0.02, 0.02, 0.025);
  for (auto _ : state)
    benchmark::DoNotOptimize(align_to_model(data.views[0], target, off * data.model_from_sensor,
                                            {{0.04, 0.7, 6000}, {0.015, 0.7, 6000}, {0.010, 0.7, 6000}}, 20));
}
BENCHMARK(align_a_view)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dressform
