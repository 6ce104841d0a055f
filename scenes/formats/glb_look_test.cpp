#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "scenes/mesh_io.h"
#include "scenes/testing/mesh_files.h"
#include "scenes/testing/texture_colors.h"

namespace dressform {
namespace {

using testing::HasSubstr;

// A GLB put together piece by piece: data are added as accessors or buffer views, the rest is JSON text.
struct GlbBuilder {
  std::string binary, views, accessors;
  int view_count = 0, accessor_count = 0;

  int view(const void* data, std::size_t size) {
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}", view_count ? "," : "", binary.size(),
                         size);
    binary.append(static_cast<const char*>(data), size);
    return view_count++;
  }
  template <class T>
  int accessor(const std::vector<T>& values, const char* type, int components, int component_type,
               const std::string& extra = "") {
    const int at = view(values.data(), values.size() * sizeof(T));
    accessors += fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}",
                             accessor_count ? "," : "", at, component_type, values.size() / components, type, extra);
    return accessor_count++;
  }
  int floats(const std::vector<float>& values, const char* type, int components) {
    return accessor(values, type, components, 5126,
                    type == std::string("VEC3") ? R"(,"min":[0,0,0],"max":[9,9,9])" : "");
  }
  std::string image(const cv::Mat& bgr) {
    std::vector<unsigned char> png;
    cv::imencode(".png", bgr, png);
    return fmt::format("{{\"bufferView\":{},\"mimeType\":\"image/png\"}}", view(png.data(), png.size()));
  }
  std::string glb(const std::string& rest) const {
    return glb_of(
        fmt::format(
            R"({{"asset":{{"version":"2.0"}},{},"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
            rest, accessors, views, (binary.size() + 3) / 4 * 4),
        binary);
  }
};

class GlbLook : public FilesTest {
 protected:
  // A square of two triangles with texture coordinates x and 1 - y; returns the attributes.
  std::string square(float x0 = 0) {
    const int position = builder_.floats({x0, 0, 0, x0 + 1, 0, 0, x0 + 1, 1, 0, x0, 1, 0}, "VEC3", 3);
    const int uv = builder_.floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
    indices_ = builder_.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR", 1, 5123);
    return fmt::format("\"POSITION\":{},\"TEXCOORD_0\":{}", position, uv);
  }
  std::string primitive(const std::string& attributes, int material, const std::string& extra = "") const {
    return fmt::format(R"({{"attributes":{{{}}},"indices":{}{}{}}})", attributes, indices_,
                       material < 0 ? "" : fmt::format(",\"material\":{}", material), extra);
  }
  std::filesystem::path write(const std::string& rest) const { return text("a.glb", builder_.glb(rest)); }
  static std::string scene(const std::string& primitives, const std::string& node = "") {
    return R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node + R"(}],"meshes":[{"primitives":[)" +
           primitives + "]}]";
  }

  GlbBuilder builder_;
  int indices_ = 0;
};

TEST_F(GlbLook, PlainColoursAreLinearAndImagesKeepTheirTexels) {
  const std::string left = primitive(square(0), 0), right = primitive(square(1), 1);
  const std::string image = builder_.image(marked_image());
  const auto path = write(scene(left + "," + right) +
                          R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},)"
                          R"({"pbrMetallicRoughness":{"baseColorFactor":[0.2140411,1,0,1]}}],)"
                          R"("textures":[{"source":0}],"images":[)" +
                          image + "]");
  const TexturedMesh found = read_textured_mesh(path);
  for_points(found, [&](std::size_t, const Vector3d& p, const cv::Vec3b& color) {
    const cv::Vec3b expected = p.x() > 1 ? cv::Vec3b(0, 255, 128) : image_at(marked_image(), p.x(), 1 - p.y());
    EXPECT_LE(cv::norm(color, expected, cv::NORM_INF), 1) << p.transpose();
  });
}

TEST_F(GlbLook, TextureTransformMovesTheImage) {
  const std::string one = primitive(square(), 0), image = builder_.image(marked_image());
  const auto path =
      write(scene(one) +
            R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":)"
            R"({"KHR_texture_transform":{"offset":[0.25,0.5],"rotation":1.5707963267948966,"scale":[2,0.5]}}}}}],)"
            R"("extensionsRequired":["KHR_texture_transform"],"extensionsUsed":["KHR_texture_transform"],)"
            R"("textures":[{"source":0}],"images":[)" +
            image + "]");
  const TexturedMesh found = read_textured_mesh(path);
  for_points(found, [&](std::size_t, const Vector3d& p, const cv::Vec3b& color) {
    const double u = p.x(), v = 1 - p.y();  // u' = 0.25 + sin * 0.5 v, v' = 0.5 - sin * 2 u
    const double moved_u = 0.25 + 0.5 * v, moved_v = 0.5 - 2 * u;
    const auto near_edge = [](double texels) { return std::abs(texels - std::round(texels)) < 1e-3; };
    if (near_edge(16 * moved_u) || near_edge(8 * moved_v)) return;
    EXPECT_EQ(color, image_at(marked_image(), moved_u, moved_v)) << p.transpose();
  });
}

TEST_F(GlbLook, MaskCutsHolesBlendIsRefusedOpaqueIgnoresAlpha) {
  cv::Mat lace(4, 4, CV_8UC4, cv::Scalar(10, 20, 30, 255));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      if (x > y) lace.at<cv::Vec4b>(y, x)[3] = 90;  // above the diagonal from top left to bottom right
  const int position = builder_.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
  const int uv = builder_.floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
  indices_ = builder_.accessor<std::uint16_t>({0, 1, 3, 1, 2, 3}, "SCALAR", 1, 5123);
  const std::string one = primitive(fmt::format("\"POSITION\":{},\"TEXCOORD_0\":{}", position, uv), 0);
  const std::string image = builder_.image(lace);
  const auto with = [&](const std::string& mode) {
    return write(scene(one) + R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})" + mode +
                 R"(}],"textures":[{"source":0}],"images":[)" + image + "]");
  };
  EXPECT_EQ(read_textured_mesh(with("")).mesh.triangles.size(), 2u);
  EXPECT_EQ(read_textured_mesh(with(R"(,"alphaMode":"MASK","alphaCutoff":0.2)")).mesh.triangles.size(), 2u);
  const TexturedMesh cut = read_textured_mesh(with(R"(,"alphaMode":"MASK")"));
  ASSERT_EQ(cut.mesh.triangles.size(), 1u);
  EXPECT_EQ(cut.mesh.vertices[2], Vector3d(0, 1, 0));
  EXPECT_THAT(refusal([&] { read_textured_mesh(with(R"(,"alphaMode":"BLEND")")); }), HasSubstr("alpha"));
}

TEST_F(GlbLook, ColoursOfVerticesAreLinear) {
  const std::string attributes =
      square() + fmt::format(",\"COLOR_0\":{}", builder_.accessor<std::uint8_t>(
                                                    {55, 0, 0, 255, 55, 0, 0, 255, 55, 0, 0, 255, 55, 0, 0, 255},
                                                    "VEC4", 4, 5121, ",\"normalized\":true"));
  for_points(read_textured_mesh(write(scene(primitive(attributes, -1)))),
             [&](std::size_t, const Vector3d&, const cv::Vec3b& color) { EXPECT_NEAR(color[2], 128, 1); });
}

TEST_F(GlbLook, MorphTargetsAreAddedAlsoSparseOnes) {
  const std::string attributes = square();
  const int step = builder_.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  const std::uint16_t which[] = {2};
  const float value[] = {0, 0, 5};
  const int at_index = builder_.view(which, sizeof which), at_value = builder_.view(value, sizeof value);
  builder_.accessors += fmt::format(
      R"(,{{"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[0,0,5],"sparse":{{"count":1,"indices":{{"bufferView":{},"componentType":5123}},"values":{{"bufferView":{}}}}}}})",
      at_index, at_value);
  const std::string targets = fmt::format(R"(,"targets":[{{"POSITION":{}}},{{"POSITION":{}}}])", step, step + 1);
  const auto heights = [&](const std::string& node, const std::string& mesh) {
    std::string json = scene(primitive(attributes, -1, targets), node);
    json.insert(json.size() - 2, mesh);
    std::vector<double> z;
    for (const auto& v : read_mesh(write(json)).vertices) z.push_back(v.z());
    return z;
  };
  EXPECT_EQ(heights("", ""), (std::vector<double>{0, 0, 0, 0}));
  EXPECT_EQ(heights(R"(,"weights":[0.5,1])", ""), (std::vector<double>{0.5, 0.5, 5.5, 0.5}));
}

TEST_F(GlbLook, SkinsGoWhereTheirJointsAre) {
  std::string attributes = square();
  attributes +=
      fmt::format(",\"JOINTS_0\":{},\"WEIGHTS_0\":{}",
                  builder_.accessor<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", 4, 5121),
                  builder_.floats({1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0.5, 0, 0, 2, 0, 0, 0}, "VEC4", 4));
  const int inverse = builder_.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1,  //
                                       1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1},
                                      "MAT4", 16);
  const auto path = write(
      R"("scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0,"translation":[100,0,0]},)"
      R"({"translation":[0,1,0],"children":[2]},{"translation":[0,0,3]}],"skins":[{"joints":[1,2],"inverseBindMatrices":)" +
      std::to_string(inverse) + R"(}],"meshes":[{"primitives":[)" + primitive(attributes, -1) + "]}]");
  const Mesh mesh = read_mesh(path);
  // Joint 0 stands where it was bound; joint 1 takes its points by (0, 1, 3).
  EXPECT_EQ(mesh.vertices[0], Vector3d(0, 0, 0));
  EXPECT_EQ(mesh.vertices[1], Vector3d(1, 1, 3));
  EXPECT_EQ(mesh.vertices[2], Vector3d(1, 1.5, 1.5));
  EXPECT_EQ(mesh.vertices[3], Vector3d(0, 1, 0)) << "weights that do not add up to 1";
}

TEST_F(GlbLook, WhatIsNotReadIsNamed) {
  const std::string one = primitive(square(), -1);
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "VENDOR_unheard_of"})
    EXPECT_THAT(refusal([&] { read_mesh(write(scene(one) + ",\"extensionsRequired\":[\"" + name + "\"]")); }),
                HasSubstr(name));
  EXPECT_THAT(refusal([&] {
                read_mesh(write(R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1,1]},{"mesh":0}],)"
                                R"("meshes":[{"primitives":[)" +
                                one + "]}]"));
              }),
              HasSubstr("node 1 is reached twice"));
  const std::string material = primitive(square(), 0);
  EXPECT_THAT(refusal([&] {
                read_textured_mesh(write(scene(material) +
                                         R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                                         R"("textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}])"));
              }),
              HasSubstr("EXT_texture_webp"));
  EXPECT_THAT(refusal([&] { read_mesh(text("deep.glb", glb_of(std::string(5000, '['), ""))); }), HasSubstr("nested"));
}

}  // namespace
}  // namespace dressform
