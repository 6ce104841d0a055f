#include <benchmark/benchmark.h>

#include "eval/score/evaluate.h"
#include "eval/testing/test_meshes.h"
#include "synthetic/body/body.h"

namespace dressform {
namespace {

TexturedMesh with_texture(const Mesh& mesh) {
  TexturedMesh result{mesh, {}, cv::Mat(2048, 2048, CV_8UC3, cv::Scalar(90, 60, 40))};
  for (const auto& t : mesh.triangles) {
    std::array<Vector2f, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[k] = Vector2f(0.5f + 0.9f * float(mesh.vertices[t[k]].x()), 0.5f * float(mesh.vertices[t[k]].y()));
    result.corner_uv.push_back(corners);
  }
  return result;
}

Mesh sleeve(double radius, double low, double high) {
  return test_meshes::tube(radius, 0.8 * radius, {0, 0, 0}, low, high, 180, 170, false);
}

// Sizes of a full run: bodies of 1.9 square metres, two garments of 60k triangles, four images of labels.
void evaluate_full_size(benchmark::State& state) {
  GroundTruth truth;
  RunOutputs outputs;
  for (const char* name : {"k1", "k2", "k3", "k4"}) {
    truth.world_from_sensor[name] = Eigen::Translation3d(0, 1.25, 2.1) * Eigen::AngleAxisd(M_PI, Vector3d::UnitX());
    outputs.model_from_sensor[name] = truth.world_from_sensor[name];
    outputs.converged[name] = true;
    truth.labels[name] = cv::Mat(1080, 1920, CV_8UC1, cv::Scalar(0));
    truth.labels[name](cv::Rect(700, 100, 300, 800)) = 2;
    outputs.labels[name] = truth.labels[name];
  }
  outputs.user_model_from_frame0 = truth.world_from_sensor["k1"];
  truth.scan_world_from_sensor["scan_user"] = {truth.world_from_sensor["k1"]};
  truth.naked_body = truth.user_body = make_body(BodySpec{}).mesh;
  outputs.naked_body = outputs.user_body = test_meshes::moved(truth.naked_body, {0.002, 0, 0});
  for (const auto& [slot, low, high] : {std::tuple("top", 0.9, 1.5), std::tuple("bottom", 0.1, 1.1)}) {
    TruthGarment garment;
    garment.mesh = sleeve(0.2, low, high);
    garment.views.assign(garment.mesh.vertices.size(), 2);
    garment.textured = with_texture(garment.mesh);
    truth.rims[slot] = {};
    truth.garments[slot] = garment;
    const Mesh estimate = sleeve(0.202, low, high);
    outputs.garments[slot] = {estimate, with_texture(estimate), sleeve(0.22, low, high)};
  }
  for (auto _ : state) benchmark::DoNotOptimize(evaluate(outputs, truth));
}
BENCHMARK(evaluate_full_size)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);

}  // namespace
}  // namespace dressform
