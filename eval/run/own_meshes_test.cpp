// A scene made of someone's own meshes: exported by the program, rescaled, re-tessellated, with other textures.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/run/scene_run.h"
#include "scenes/mesh_io.h"
#include "synthetic/body/body.h"
#include "synthetic/garments/garment.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kStretch = 0.96;

// Every triangle in four, and everything smaller.
Mesh subdivided(const Mesh& mesh) {
  Mesh result;
  for (const auto& vertex : mesh.vertices) result.vertices.push_back(kStretch * vertex);
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(result.vertices.size()));
    if (fresh) result.vertices.push_back(0.5 * (result.vertices[a] + result.vertices[b]));
    return at->second;
  };
  for (const auto& t : mesh.triangles) {
    const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    for (const Vector3i& part : {Vector3i(t[0], a, c), Vector3i(a, t[1], b), Vector3i(c, b, t[2]), Vector3i(a, b, c)})
      result.triangles.push_back(part);
  }
  return result;
}

std::vector<std::array<Vector2f, 3>> subdivided(const std::vector<std::array<Vector2f, 3>>& corner_uv) {
  std::vector<std::array<Vector2f, 3>> result;
  for (const auto& uv : corner_uv) {
    const Vector2f a = (uv[0] + uv[1]) / 2, b = (uv[1] + uv[2]) / 2, c = (uv[2] + uv[0]) / 2;
    result.push_back({uv[0], a, c});
    result.push_back({a, uv[1], b});
    result.push_back({c, b, uv[2]});
    result.push_back({a, b, c});
  }
  return result;
}

cv::Mat plaid(const cv::Scalar& ground, const cv::Scalar& lines) {
  cv::Mat image(1024, 1024, CV_8UC3, ground);
  for (int at = 0; at < 1024; at += 64) {
    cv::rectangle(image, {at, 0}, {at + 14, 1023}, lines, cv::FILLED);
    cv::rectangle(image, {0, at}, {1023, at + 8}, lines * 0.6, cv::FILLED);
  }
  return image;
}

void write_plain_obj(const fs::path& file, const Mesh& mesh) {
  std::ofstream out(file);
  out.precision(9);
  for (const auto& v : mesh.vertices) out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const auto& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
}

// Writes the meshes and the scene file; returns the scene file.
fs::path write_own_scene(const fs::path& folder) {
  const fs::path library = fs::path(DRESSFORM_SOURCE_DIR) / "scenes/library";
  const Scene donor = read_scene(library / "group4.toml");
  const Body body = make_body(donor.body);
  write_plain_obj(folder / "body.obj", subdivided(body.mesh));
  std::vector<Garment> worn;
  std::string tables;
  for (const bool top : {false, true})
    for (const auto& spec : donor.garments)
      if ((spec.slot == "top") == top) {
        worn.push_back(make_garment(spec, body, worn, 1));
        const TexturedMesh& garment = worn.back().textured;
        const cv::Scalar ground = top ? cv::Scalar(60, 140, 220) : cv::Scalar(70, 60, 90);
        write_obj(folder / (spec.slot + ".obj"),
                  {subdivided(garment.mesh), subdivided(garment.corner_uv), plaid(ground, ground * 0.5)});
        cv::imwrite((folder / (spec.slot + "_cloth.png")).string(), plaid(ground, ground * 0.5));
        tables += "[[garment]]\nmesh = \"" + spec.slot + ".obj\"\ntexture = \"" + spec.slot +
                  "_cloth.png\"\nkind = \"" + spec.kind + "\"\n";
      }
  std::ofstream(folder / "own.toml") << "name = \"own\"\nroom = \"" << (library / "rooms/laboratory.toml").string()
                                     << "\"\nuser = \"" << (library / "bodies/customer.toml").string() << "\"\nrig = \""
                                     << (library / "rigs/thesis.toml").string() << "\"\nscan = \""
                                     << (library / "scans/handheld.toml").string()
                                     << "\"\n[body]\nmesh = \"body.obj\"\n"
                                     << tables;
  return folder / "own.toml";
}

TEST(EndToEndOwnMeshes, RunThroughToFittedClothes) {
  const fs::path folder = fs::path(testing::TempDir()) / "road_own_meshes";
  fs::remove_all(folder);
  fs::create_directories(folder);
  SceneRunRequest request;
  request.scene = scaled(read_scene(write_own_scene(folder)), 0.4);
  request.scale = 0.4;
  request.output = folder / "run";
  request.store = folder / "store";
  const auto result = run_scene(request);
  ASSERT_TRUE(result.scores);
  const std::map<std::string, int> loops = {{"top", 4}, {"bottom", 2}};
  for (const auto& [slot, expected] : loops) {
    for (const char* suffix : {"", "_fitted"}) {
      const auto garment = read_textured_mesh(folder / "run/out" / (slot + suffix + ".glb"));
      const Topology shape = topology(garment.mesh);
      EXPECT_EQ(shape.loops, expected) << slot << suffix;
      EXPECT_EQ(shape.components, 1) << slot << suffix;
      EXPECT_EQ(shape.boundary_edges, 2 * shape.vertices - shape.triangles - 2 * shape.euler());
      EXPECT_FALSE(garment.texture.empty());
    }
  }
}

}  // namespace
}  // namespace dressform
