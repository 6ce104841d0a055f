#include "scenes/mesh_io.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/testing/mesh_files.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

class MeshIo : public FilesTest {
 protected:
  void expect_input_error(const fs::path& path, const std::string& part) const {
    const std::string message = refusal([&] { read_mesh(path); });
    EXPECT_THAT(message, testing::HasSubstr(path.filename().string()));
    EXPECT_THAT(message, testing::HasSubstr(part));
  }
};

void expect_same(const TexturedMesh& found, const TexturedMesh& expected, double tolerance) {
  const Topology a = topology(found.mesh), b = topology(expected.mesh);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.euler(), b.euler());
  EXPECT_EQ(a.loops, b.loops);
  ASSERT_EQ(found.corner_uv.size(), expected.corner_uv.size());
  for (std::size_t i = 0; i < found.corner_uv.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT((found.corner_uv[i][k] - expected.corner_uv[i][k]).norm(), 1e-6);
      const Vector3d& p = found.mesh.vertices[found.mesh.triangles[i][k]];
      EXPECT_LE((p - expected.mesh.vertices[expected.mesh.triangles[i][k]]).norm(), tolerance);
    }
  ASSERT_EQ(found.texture.size(), expected.texture.size());
  EXPECT_EQ(cv::norm(found.texture, expected.texture, cv::NORM_INF), 0);
}

TEST_F(MeshIo, GlbKeepsTopologyOverTheSeam) {
  write_glb(file("tube.glb"), tube());
  expect_same(read_textured_mesh(file("tube.glb")), tube(), 1e-7);
  EXPECT_EQ(topology(read_mesh(file("tube.glb"))).loops, 2);
}

TEST_F(MeshIo, ObjKeepsEverythingExactly) {
  write_obj(file("tube.obj"), tube());
  expect_same(read_textured_mesh(file("tube.obj")), tube(), 0);
  EXPECT_TRUE(fs::exists(file("tube.mtl")));
  EXPECT_TRUE(fs::exists(file("tube.png")));
}

TEST_F(MeshIo, PlyKeepsDoublesPropertiesAndCorners) {
  PlyExtras extras;
  extras.corner_uv = tube().corner_uv;
  extras.texture_file = "cloth.png";
  extras.normals = vertex_normals(tube().mesh);
  extras.colors.assign(tube().mesh.vertices.size(), Vector3f(1, 0.5f, 0));
  extras.vertex_properties["views"].assign(tube().mesh.vertices.size(), 3);
  cv::imwrite(file("cloth.png").string(), marked_image());
  write_ply(file("tube.ply"), tube().mesh, extras);
  expect_same(read_textured_mesh(file("tube.ply")), tube(), 0);
  EXPECT_EQ(read_ply_vertex_property(file("tube.ply"), "views"), extras.vertex_properties["views"]);
  EXPECT_EQ(read_ply_vertex_property(file("tube.ply"), "green")[0], 128);
  EXPECT_THROW(read_ply_vertex_property(file("tube.ply"), "absent"), InputError);
}

TEST_F(MeshIo, PlyOfACloud) {
  PointCloud cloud;
  cloud.points = {{1, 2, 3}, {4, 5, 6}};
  cloud.normals = {{0, 1, 0}, {1, 0, 0}};
  cloud.views = {7, 2};
  write_ply(file("cloud.ply"), cloud);
  EXPECT_EQ(read_ply_vertex_property(file("cloud.ply"), "view"), (std::vector<std::uint8_t>{7, 2}));
  cloud.normals.pop_back();
  EXPECT_THROW(write_ply(file("cloud.ply"), cloud), std::invalid_argument);
}

TEST_F(MeshIo, WritingLeavesNoTemporaryFilesAndTheSameBytes) {
  write_glb(file("a.glb"), tube());
  write_glb(file("b.glb"), tube());
  EXPECT_EQ(read_file_bytes(file("a.glb")), read_file_bytes(file("b.glb")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
  EXPECT_THROW(write_glb(file("no/such/folder/a.glb"), tube()), InputError);
}

TEST_F(MeshIo, ObjTopOfTheImageIsVOne) {
  cv::imwrite(file("p.png").string(), marked_image());
  text("m.mtl", "newmtl a\nmap_Kd p.png\n");
  const auto path = text("a.obj",
                         "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                         "usemtl a\nf -4/-4 -3/-3 -2/-2 -1/-1\n");
  const TexturedMesh found = read_textured_mesh(path);
  ASSERT_EQ(found.mesh.triangles.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    for (int k = 0; k < 3; ++k) {
      const Vector3d& p = found.mesh.vertices[found.mesh.triangles[i][k]];
      EXPECT_EQ(found.corner_uv[i][k], Vector2f(float(p.x()), float(1 - p.y())));
    }
}

TEST_F(MeshIo, GlbOfAnotherProgramWithMovedAndMirroredNodes) {
  // Two nodes of one triangle: moved by (10, 0, 0) within a parent at (0, 5, 0); mirrored in x.
  const float position[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::string binary(reinterpret_cast<const char*>(position), sizeof position);
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,2]}],"nodes":[{"translation":[0,5,0],"children":[1]},)"
      R"({"mesh":0,"translation":[10,0,0]},{"mesh":0,"scale":[-1,1,1]}],"meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
      R"("min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]})";
  while (json.size() % 4) json += ' ';
  const auto word = [](std::uint32_t value) { return std::string(reinterpret_cast<const char*>(&value), 4); };
  const auto size = static_cast<std::uint32_t>(json.size());
  const std::string glb = "glTF" + word(2) + word(12 + 8 + size + 8 + 36) + word(size) + "JSON" + json + word(36) +
                          std::string("BIN\0", 4) + binary;
  const Mesh mesh = read_mesh(text("a.glb", glb));
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices[0], Vector3d(10, 5, 0));
  for (const auto& normal : vertex_normals(mesh)) EXPECT_GT(normal.z(), 0.9);  // the mirrored one is not turned over
}

TEST_F(MeshIo, PlyOfAnotherProgram) {
  const auto path = text("a.ply",
                         "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement vertex 4\r\nproperty float x\r\n"
                         "property float y\r\nproperty float z\r\nproperty float nx\r\nproperty uchar red\r\n"
                         "property float quality\r\nelement face 1\r\nproperty list uchar uint vertex_index\r\n"
                         "property int flags\r\nelement edge 1\r\nproperty int vertex1\r\nend_header\r\n"
                         "0 0 0 1 255 .5\r\n1 0 0 1 255 .5\r\n1 1 0 1 0 1e-3\r\n0 1 0 1 0 +2\r\n4 0 1 2 3 9\r\n5\r\n");
  const Mesh mesh = read_mesh(path);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST_F(MeshIo, PlySplitAtItsSeamIsJoined) {  // as Blender and MeshLab write it
  const TexturedMesh expected = tube();
  std::string out = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(3 * expected.mesh.triangles.size()) +
                    "\nproperty float x\nproperty float y\nproperty float z\nproperty float s\nproperty float t\n"
                    "property uchar views\nelement face " +
                    std::to_string(expected.mesh.triangles.size()) +
                    "\nproperty list uchar int vertex_indices\nend_header\n";
  std::string faces;
  for (std::size_t i = 0; i < expected.mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d& p = expected.mesh.vertices[expected.mesh.triangles[i][k]];
      const Vector2f& uv = expected.corner_uv[i][k];
      out += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + " " +
             std::to_string(uv.x()) + " " + std::to_string(1 - uv.y()) + " " + std::to_string(p.y() > 0.95) + "\n";
    }
    faces += "3 " + std::to_string(3 * i) + " " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) + "\n";
  }
  cv::imwrite(file("p.png").string(), marked_image());
  const auto path = text("a.ply", out + faces);
  const TexturedMesh found = read_textured_mesh(path, file("p.png"));
  EXPECT_EQ(topology(found.mesh).vertices, topology(expected.mesh).vertices);
  EXPECT_EQ(topology(found.mesh).loops, 2);
  const auto views = read_ply_vertex_property(path, "views");
  ASSERT_EQ(views.size(), found.mesh.vertices.size());
  for (std::size_t v = 0; v < views.size(); ++v) EXPECT_EQ(views[v], found.mesh.vertices[v].y() > 0.95);
}

TEST_F(MeshIo, UglyInputIsNamed) {
  expect_input_error(file("absent.ply"), "no such file");
  expect_input_error(text("a.stl", "solid"), ".stl");
  expect_input_error(text("empty.ply", ""), "header");
  expect_input_error(text("empty.obj", ""), "no triangle");
  expect_input_error(text("empty.glb", ""), "too short");
  expect_input_error(text("noise.glb", std::string(500, 'x')), "not a readable GLB");
  expect_input_error(text("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "finite");
  expect_input_error(text("word.obj", "v 0 0 abc\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), ":1");
  expect_input_error(text("short.obj", "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n"), ":2");
  expect_input_error(text("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), "does not exist");
  expect_input_error(text("range4.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 9\n"), "does not exist");
  expect_input_error(text("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"), "from 1 on");
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  expect_input_error(text("range.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "out of range");
  expect_input_error(text("negative.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), "out of range");
  expect_input_error(text("nan.ply", header + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"), "finite");
  expect_input_error(text("line.ply", header + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n"), "corners");
  expect_input_error(text("word.ply", header + "0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n"), "number");
}

TEST_F(MeshIo, EveryTruncationIsAnInputError) {
  write_ply(file("a.ply"), tube(4, 1).mesh);
  write_glb(file("a.glb"), tube(4, 1));
  for (const char* name : {"a.ply", "a.glb"}) {
    const std::string bytes = read_file_bytes(file(name));
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 40)
      EXPECT_THROW(read_mesh(text(std::string("cut_") + name, bytes.substr(0, size))), InputError) << size;
  }
}

TEST_F(MeshIo, AbsurdCountsAreRefused) {
  expect_input_error(text("a.ply",
                          "ply\nformat binary_little_endian 1.0\nelement vertex 999999999999\nproperty float x\n"
                          "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                          "end_header\n"),
                     "end early");
}

TEST_F(MeshIo, MissingTexturesAreNamed) {
  write_obj(file("a.obj"), tube());
  fs::remove(file("a.png"));
  const auto message = [&](const fs::path& path, const fs::path& texture = {}) -> std::string {
    try {
      read_textured_mesh(path, texture);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(message(file("a.obj")), testing::HasSubstr("a.png"));
  EXPECT_THAT(message(file("a.obj"), file("b.png")), testing::HasSubstr("b.png"));
  EXPECT_THAT(message(file("a.obj"), text("c.png", "no image")), testing::HasSubstr("c.png"));
  fs::remove(file("a.mtl"));
  EXPECT_THAT(message(file("a.obj")), testing::HasSubstr("a.mtl"));
  EXPECT_NO_THROW(read_mesh(file("a.obj")));
  EXPECT_THAT(message(text("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), file("a.png")),
              testing::HasSubstr("texture coordinates"));
  EXPECT_THAT(message(text("half.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2 3\n"), file("a.png")),
              testing::HasSubstr("texture coordinates"));
}

TEST_F(MeshIo, RepeatedTexturesStartInsideTheImage) {
  cv::imwrite(file("p.png").string(), marked_image());
  const auto path = text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 3 -2\nvt 3.5 -2\nvt 3 -1\nf 1/1 2/2 3/3\n");
  const auto uv = read_textured_mesh(path, file("p.png")).corner_uv[0];
  EXPECT_EQ(uv[0], Vector2f(0, 1));
  EXPECT_EQ(uv[1], Vector2f(0.5f, 1));
  EXPECT_EQ(uv[2], Vector2f(0, 0));
}

TEST_F(MeshIo, CoincidentInnerVerticesStayApart) {  // two sheets that touch in a point must not be welded there
  TexturedMesh mesh;
  for (int sheet = 0; sheet < 2; ++sheet) {
    const int first = static_cast<int>(mesh.mesh.vertices.size());
    mesh.mesh.vertices.emplace_back(0, 0, 0);
    for (int i = 0; i < 4; ++i)
      mesh.mesh.vertices.emplace_back(std::cos(i * M_PI / 2), std::sin(i * M_PI / 2), sheet ? 1 : -1);
    for (int i = 0; i < 4; ++i) {
      mesh.mesh.triangles.emplace_back(first, first + 1 + i, first + 1 + (i + 1) % 4);
      mesh.corner_uv.emplace_back();
      for (int k = 0; k < 3; ++k)
        mesh.corner_uv.back()[k] = mesh.mesh.vertices[mesh.mesh.triangles.back()[k]].head<2>().cast<float>();
    }
  }
  mesh.texture = marked_image();
  write_glb(file("a.glb"), mesh);
  EXPECT_EQ(topology(read_mesh(file("a.glb"))).components, 2);
}

}  // namespace
}  // namespace dressform
