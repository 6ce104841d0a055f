// Garments and a body through other people's programs and back: what Blender and MeshLab export of what they were given
// is read as the same surface with the same colours; and our GLB is a valid one. Where the programs are not there
// (Debian's blender; meshlab, xvfb; node with the package gltf-validator), the tests say so and are skipped; those of
// the garments take minutes and run where DRESSFORM_ROUND_TRIP is set.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>

#include "eval/metrics/mesh_distance.h"
#include "eval/testing/test_meshes.h"
#include "scenes/file_bytes.h"
#include "scenes/mesh_io.h"
#include "scenes/scene.h"
#include "synthetic/body/body.h"
#include "synthetic/garments/garment.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kSame_m = 1e-4, kSameLevels = 1;

// Whether a shell command ends well; what it printed is in `log`.
bool runs(const std::string& command, const fs::path& log = "/dev/null") {
  return std::system((command + " >'" + log.string() + "' 2>&1").c_str()) == 0;
}

// Why the garments are not sent round; empty: they are.
std::string not_asked_for() {
  return std::getenv("DRESSFORM_ROUND_TRIP") ? "" : "it takes minutes: set DRESSFORM_ROUND_TRIP=1 to run it";
}

bool has_program(const std::string& name) { return runs("command -v " + name); }

// numpy has lost the names that this add-on of Debian 12's Blender still uses.
constexpr const char* kBlenderScript = R"(import sys
import numpy
numpy.bool = bool
import bpy
for line in open(sys.argv[sys.argv.index("--") + 1]):
    source, target = line.rstrip("\n").split("\t")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if source.endswith(".glb"):
        bpy.ops.import_scene.gltf(filepath=source)
    elif source.endswith(".ply"):
        bpy.ops.import_mesh.ply(filepath=source)
    else:
        bpy.ops.wm.obj_import(filepath=source)
    if target.endswith(".glb"):
        bpy.ops.export_scene.gltf(filepath=target, export_format="GLB")
    elif target.endswith(".ply"):
        bpy.ops.export_mesh.ply(filepath=target)
    else:
        bpy.ops.wm.obj_export(filepath=target, path_mode="COPY")
print("all exported")
)";

using Ways = std::vector<std::pair<fs::path, fs::path>>;  // what goes in, what shall come out

void through_blender(const Ways& ways, const fs::path& folder) {
  std::ofstream list(folder / "ways.txt");
  for (const auto& [source, target] : ways) list << source.string() << '\t' << target.string() << '\n';
  list.close();
  std::ofstream(folder / "convert.py") << kBlenderScript;
  const fs::path log = folder / "blender.log";
  runs("blender --background --factory-startup --python '" + (folder / "convert.py").string() + "' -- '" +
           (folder / "ways.txt").string() + "'",
       log);
  ASSERT_NE(read_file_bytes(log).find("all exported"), std::string::npos) << read_file_bytes(log);
}

void through_meshlab(const Ways& ways, const fs::path& folder) {
  for (const auto& [source, target] : ways) {
    const fs::path log = folder / "meshlab.log";
    const std::string look = source.stem() == "body" ? "" : " -m wt";  // texture coordinates of corners
    ASSERT_TRUE(runs("cd '" + folder.string() + "' && xvfb-run -a meshlabserver -i '" + source.string() + "' -o '" +
                         target.string() + "'" + look,
                     log))
        << read_file_bytes(log);
  }
}

Vector3d at_weights(const Mesh& mesh, int triangle, const Vector3d& weights) {
  Vector3d point = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) point += weights[k] * mesh.vertices[mesh.triangles[triangle][k]];
  return point;
}

const Vector3d kInside(0.41, 0.33, 0.26);  // off centre, and on no edge of any triangle

std::vector<Vector3d> points_of(const Mesh& mesh) {
  std::vector<Vector3d> points = mesh.vertices;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) points.push_back(at_weights(mesh, t, kInside));
  return points;
}

double farthest_m(const Mesh& from, const metrics::MeshDistance& to) {
  double farthest = 0;
  for (const auto& nearest : to.nearest(points_of(from))) farthest = std::max(farthest, nearest.distance_m);
  return farthest;
}

// Bilinear between texel centres, not rounded; v down.
cv::Vec3d color_at(const TexturedMesh& mesh, int triangle, const Vector3d& weights) {
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  for (int k = 0; k < 3; ++k) uv += weights[k] * mesh.corner_uv[triangle][k].cast<double>();
  const double x = uv.x() * mesh.texture.cols - 0.5, y = uv.y() * mesh.texture.rows - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  cv::Vec3d sum(0, 0, 0);
  for (const int j : {0, 1})
    for (const int i : {0, 1}) {
      const double weight = (i ? x - x0 : 1 - x + x0) * (j ? y - y0 : 1 - y + y0);
      const auto texel = mesh.texture.at<cv::Vec3b>(std::clamp(y0 + j, 0, mesh.texture.rows - 1),
                                                    std::clamp(x0 + i, 0, mesh.texture.cols - 1));
      sum += weight * cv::Vec3d(texel[0], texel[1], texel[2]);
    }
  return sum;
}

// The most that a colour differs, levels of 255, over all triangles of `mesh`.
double farthest_color(const TexturedMesh& mesh, const TexturedMesh& original, const metrics::MeshDistance& surface) {
  double farthest = 0;
  for (int t = 0; t < static_cast<int>(mesh.mesh.triangles.size()); ++t) {
    const auto nearest = surface.nearest(at_weights(mesh.mesh, t, kInside));
    const cv::Vec3d off = color_at(mesh, t, kInside) - color_at(original, nearest.triangle, nearest.weights);
    for (int k = 0; k < 3; ++k) farthest = std::max(farthest, std::abs(off[k]));
  }
  return farthest;
}

// Four garments and a body of the library, written as OBJ, PLY and GLB.
class RoundTrip : public testing::Test {
 protected:
  static void make_once() {
    if (!garments_.empty()) return;
    folder_ = fs::path(testing::TempDir()) / "round_trip";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const fs::path library = fs::path(DRESSFORM_SOURCE_DIR) / "scenes/library";
    for (const auto& [scene, slots] : std::map<std::string, std::vector<std::string>>{
             {"group1", {"bottom", "top"}}, {"group3", {"top"}}, {"group4", {"bottom"}}}) {
      const Scene donor = read_scene(library / (scene + ".toml"));
      const Body body = make_body(donor.body);
      body_ = body.mesh;
      for (const auto& slot : slots)
        for (const auto& spec : donor.garments)
          if (spec.slot == slot) garments_[scene + "_" + slot] = make_garment(spec, body, {}, 1).textured;
    }
    for (const auto& [name, garment] : garments_) {
      write_obj(folder_ / (name + ".obj"), garment);
      write_glb(folder_ / (name + ".glb"), garment);
      PlyExtras extras;
      extras.corner_uv = garment.corner_uv;
      extras.texture_file = name + ".png";
      write_ply(folder_ / (name + ".ply"), garment.mesh, extras);
      ASSERT_TRUE(fs::exists(folder_ / extras.texture_file)) << "write_obj names its picture otherwise";
    }
    write_ply(folder_ / "body.ply", body_);
    std::ofstream obj(folder_ / "body.obj");
    obj.precision(9);
    for (const auto& v : body_.vertices) obj << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    for (const auto& t : body_.triangles) obj << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }

  // Ways of every garment and the body from one format into others; what comes out is `program`_<name>_<from>.<to>.
  static Ways ways(const std::string& program, const std::string& from, const std::vector<std::string>& to,
                   const std::vector<std::string>& body_to) {
    Ways result;
    const auto add = [&](const std::string& name, const std::vector<std::string>& formats) {
      for (const auto& format : formats)
        result.emplace_back(folder_ / (name + "." + from),
                            folder_ / (program + "_" + name + "_" + from + "." + format));
    };
    for (const auto& [name, garment] : garments_) add(name, to);
    add("body", body_to);
    return result;
  }

  static void expect_the_same(const Ways& ways) {
    for (const auto& [source, target] : ways) {
      const std::string name = source.stem().string();
      const auto garment = garments_.find(name);
      const Mesh& original = garment == garments_.end() ? body_ : garment->second.mesh;
      const TexturedMesh found =
          garment == garments_.end() ? TexturedMesh{read_mesh(target), {}, {}} : read_textured_mesh(target);
      const metrics::MeshDistance there(original), back(found.mesh);
      EXPECT_LE(farthest_m(found.mesh, there), kSame_m) << target.filename();
      EXPECT_LE(farthest_m(original, back), kSame_m) << target.filename();
      if (garment == garments_.end()) continue;
      EXPECT_EQ(topology(found.mesh).loops, topology(original).loops) << target.filename();
      EXPECT_LE(farthest_color(found, garment->second, there), kSameLevels) << target.filename();
    }
  }

  static fs::path folder_;
  static Mesh body_;
  static std::map<std::string, TexturedMesh> garments_;
};
fs::path RoundTrip::folder_;
Mesh RoundTrip::body_;
std::map<std::string, TexturedMesh> RoundTrip::garments_;

TEST_F(RoundTrip, ThroughBlender) {
  if (const std::string why = not_asked_for(); !why.empty()) GTEST_SKIP() << why;
  if (!has_program("blender")) GTEST_SKIP() << "Debian's package blender is not installed";
  make_once();
  Ways all = ways("blender", "obj", {"obj", "glb"}, {"obj", "glb"});
  for (const auto& [from, to, body_to] :
       {std::tuple<const char*, std::vector<std::string>, std::vector<std::string>>{"glb", {"glb"}, {}},
        {"ply", {}, {"ply"}}})
    for (const auto& way : ways("blender", from, to, body_to)) all.push_back(way);
  ASSERT_NO_FATAL_FAILURE(through_blender(all, folder_));
  expect_the_same(all);
}

TEST_F(RoundTrip, ThroughMeshLab) {
  if (const std::string why = not_asked_for(); !why.empty()) GTEST_SKIP() << why;
  if (!has_program("meshlabserver") || !has_program("xvfb-run"))
    GTEST_SKIP() << "Debian's packages meshlab and xvfb are not installed";
  make_once();
  const Ways all = ways("meshlab", "ply", {"ply", "obj"}, {"ply", "obj"});  // its OBJ reader stops at an assertion
  ASSERT_NO_FATAL_FAILURE(through_meshlab(all, folder_));
  expect_the_same(all);
}

TEST(GlbFile, PassesTheKhronosValidator) {
  const fs::path folder = fs::path(testing::TempDir()) / "glb_validator";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "validate.cjs") << R"(const validator = require("gltf-validator"), fs = require("fs");
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then((report) => {
  console.log(JSON.stringify(report.issues, null, 1));
  process.exit(report.issues.numErrors + report.issues.numWarnings > 0 ? 1 : 0);
});
)";
  // From $NODE_PATH, or the folders of global packages.
  const std::string node = "NODE_PATH=\"$NODE_PATH:$(npm root -g 2>/dev/null):/usr/share/nodejs\" node ";
  if (!runs(node + "-e 'require(\"gltf-validator\")'")) GTEST_SKIP() << "node has no package gltf-validator";
  TexturedMesh tube;
  tube.mesh = test_meshes::tube(0.2, 0.15, {0, 0, 0}, 0.9, 1.4, 24, 12, false);
  for (const auto& t : tube.mesh.triangles) {
    std::array<Vector2f, 3> uv;
    for (int k = 0; k < 3; ++k)
      uv[k] = Vector2f(static_cast<float>(t[k] % 24) / 24, static_cast<float>(t[k] / 24) / 12);
    tube.corner_uv.push_back(uv);
  }
  tube.texture = cv::Mat(64, 32, CV_8UC3, cv::Scalar(40, 90, 200));
  write_glb(folder / "tube.glb", tube);
  const fs::path log = folder / "report.json";
  EXPECT_TRUE(runs(node + "'" + (folder / "validate.cjs").string() + "' '" + (folder / "tube.glb").string() + "'", log))
      << read_file_bytes(log);
  // The test can fail: half a file is no GLB.
  const std::string bytes = read_file_bytes(folder / "tube.glb");
  write_file_atomically(folder / "half.glb", bytes.substr(0, bytes.size() / 2));
  EXPECT_FALSE(
      runs(node + "'" + (folder / "validate.cjs").string() + "' '" + (folder / "half.glb").string() + "'", log));
}

}  // namespace
}  // namespace dressform
