#include <benchmark/benchmark.h>

#include <cmath>

#include "render/renderer.h"

namespace dressform {
namespace {

// A body-sized ellipsoid of about `triangles` triangles with a chequered texture of 4096 x 4096.
TexturedMesh body(int triangles) {
  TexturedMesh result;
  const int rings = static_cast<int>(std::sqrt(triangles / 4.0)), sectors = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double polar = M_PI * i / rings, turn = 2 * M_PI * j / sectors;
      result.mesh.vertices.push_back({0.3 * std::sin(polar) * std::sin(turn), 0.92 + 0.92 * std::cos(polar),
                                      0.2 * std::sin(polar) * std::cos(turn)});
    }
  const auto uv = [&](int i, int j) { return Vector2f(j / float(sectors), i / float(rings)); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const int next = (j + 1) % sectors, a = i * sectors + j, b = i * sectors + next;
      result.mesh.triangles.push_back({a, a + sectors, b + sectors});
      result.corner_uv.push_back({uv(i, j), uv(i + 1, j), uv(i + 1, j + 1)});
      result.mesh.triangles.push_back({a, b + sectors, b});
      result.corner_uv.push_back({uv(i, j), uv(i + 1, j + 1), uv(i, j + 1)});
    }
  result.texture = cv::Mat(4096, 4096, CV_8UC3);
  for (int y = 0; y < 4096; ++y)
    for (int x = 0; x < 4096; ++x)
      result.texture.at<cv::Vec3b>(y, x) = (x / 64 + y / 64) % 2 ? cv::Vec3b(40, 40, 160) : cv::Vec3b(220, 220, 220);
  return result;
}

// Arguments: triangles, samples, views drawn from one upload.
void render_textured(benchmark::State& state) {
  const TexturedMesh mesh = body(static_cast<int>(state.range(0)));
  Renderer renderer;
  RenderItem item;
  item.textured = &mesh;
  item.shading = Shading::textured;
  RenderOptions options;
  options.samples = static_cast<int>(state.range(1));
  const std::vector<RenderView> views(state.range(2), look_at_box({-0.3, 0, -0.2}, {0.3, 1.84, 0.2}, 20, 5, 800, 1000));
  for (auto _ : state) benchmark::DoNotOptimize(renderer.render(views, {item}, options));
  state.counters["views/s"] =
      benchmark::Counter(static_cast<double>(views.size() * state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(render_textured)
    ->Args({40000, 1, 1})
    ->Args({40000, 1, 16})
    ->Args({40000, 4, 16})
    ->Args({400000, 1, 16})
    ->Args({400000, 4, 16})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void render_normals(benchmark::State& state) {
  const TexturedMesh mesh = body(static_cast<int>(state.range(0)));
  Renderer renderer;
  RenderItem item;
  item.mesh = &mesh.mesh;
  item.shading = Shading::normals;
  const RenderView view = look_at_box({-0.3, 0, -0.2}, {0.3, 1.84, 0.2}, 20, 5, 800, 1000);
  for (auto _ : state) benchmark::DoNotOptimize(renderer.render(view, {item}));
}
BENCHMARK(render_normals)->Arg(40000)->Arg(400000)->Unit(benchmark::kMillisecond)->UseRealTime();

void make_context(benchmark::State& state) {
  for (auto _ : state) Renderer renderer;
}
BENCHMARK(make_context)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dressform
