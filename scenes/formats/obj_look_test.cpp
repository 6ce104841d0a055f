#include <opencv2/imgcodecs.hpp>

#include "scenes/mesh_io.h"
#include "scenes/testing/mesh_files.h"
#include "scenes/testing/texture_colors.h"

namespace dressform {
namespace {

using testing::HasSubstr;

// Two unit squares in the plane z = 0: x 0 to 1 is of the material "left", x 1 to 2 of "right".
const char* const kSquares =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl left\nf 1/1 2/2 3/3 4/4\nusemtl right\nf 2/1 5/2 6/3 3/4\n";

class ObjLook : public FilesTest {
 protected:
  ObjLook() { cv::imwrite(file("p.png").string(), marked_image()); }

  TexturedMesh squares(const std::string& library) const {
    text("m.mtl", library);
    return read_textured_mesh(text("a.obj", std::string("mtllib m.mtl\n") + kSquares));
  }
  std::string refused(const std::string& library) const {
    return refusal([&] { squares(library); });
  }
};

const char* const kBoth = "newmtl left\nmap_Kd p.png\nnewmtl right\nmap_Kd p.png\n";

TEST_F(ObjLook, LibrariesAreFoundByTheirWholeNames) {
  const TexturedMesh expected = squares(kBoth);
  text("blue shirt.mtl", kBoth);
  text("other.mtl", "newmtl nothing\nKd 1 0 0\n");
  text("sub/n.mtl", "newmtl left\nmap_Kd ..\\p.png\nnewmtl right\nmap_Kd ..\\p.png\n");
  for (const char* line : {"mtllib blue shirt.mtl", "mtllib other.mtl blue shirt.mtl", "mtllib .\\m.mtl",
                           "mtllib sub\\n.mtl", "mtllib \"blue shirt.mtl\"", "mtllib other.mtl\r\nmtllib m.mtl\r"}) {
    const TexturedMesh found = read_textured_mesh(text("b.obj", std::string(line) + "\n" + kSquares));
    EXPECT_EQ(found.corner_uv, expected.corner_uv) << line;
    EXPECT_EQ(cv::norm(found.texture, expected.texture, cv::NORM_INF), 0) << line;
  }
}

TEST_F(ObjLook, WhatIsNotFoundIsNamed) {
  const auto lost = text("lost.obj", std::string("mtllib lost library.mtl\n") + kSquares);
  EXPECT_THAT(refusal([&] { read_textured_mesh(lost); }), HasSubstr("lost library.mtl: found no such file"));
  EXPECT_THAT(refusal([&] { read_mesh_as_it_looks(lost); }), HasSubstr("lost library.mtl"));
  EXPECT_EQ(read_mesh(lost).triangles.size(), 4u);
  EXPECT_THAT(refused("newmtl left\nmap_Kd p.png\n"), HasSubstr("usemtl \"right\""));
  EXPECT_THAT(refused("newmtl left\nmap_Kd no such.png\nnewmtl right\nKd 1 1 1\n"), HasSubstr("no such.png"));
}

TEST_F(ObjLook, NamesOfMaterialsAndImagesMayHoldBlanks) {
  cv::imwrite(file("blue cloth.png").string(), marked_image());
  text("m.mtl", "newmtl the left  one\nmap_Kd -bm 1.0 -blendu on blue cloth.png\n");
  const auto found = read_textured_mesh(
      text("a.obj",
           "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl the left  one\nf 1/1 2/2 3/3\n"));
  EXPECT_EQ(cv::norm(found.texture, marked_image(), cv::NORM_INF), 0);
}

TEST_F(ObjLook, PlainAndPicturedMaterialsLieSideBySide) {
  const TexturedMesh found = squares("newmtl left\nKd 1 1 1\nmap_Kd p.png\nnewmtl right\nKd 0.9 0.5 0.2\n");
  ASSERT_EQ(found.mesh.triangles.size(), 4u);
  for_points(found, [&](std::size_t, const Vector3d& p, const cv::Vec3b& color) {
    const cv::Vec3b expected = p.x() > 1 ? cv::Vec3b(51, 128, 230) : image_at(marked_image(), p.x(), 1 - p.y());
    EXPECT_LE(cv::norm(color, expected, cv::NORM_INF), 1) << p.transpose();
  });
}

TEST_F(ObjLook, TwoPicturesLieSideBySideWithTheirRepeats) {
  cv::Mat other(32, 8, CV_8UC3);
  cv::randu(other, 0, 256);
  cv::imwrite(file("q.png").string(), other);
  const TexturedMesh found =
      squares("newmtl left\nmap_Kd -s 2.5 3 1 -o 0.25 -0.5 0 p.png\nnewmtl right\nmap_Kd q.png\n");
  for (const auto& corners : found.corner_uv)
    for (const auto& uv : corners) EXPECT_TRUE(uv.minCoeff() >= 0 && uv.maxCoeff() <= 1);
  for_points(found, [&](std::size_t, const Vector3d& p, const cv::Vec3b& color) {
    const cv::Vec3b expected = p.x() > 1 ? image_at(other, p.x() - 1, 1 - p.y())
                                         : image_at(marked_image(), 2.5 * p.x() + 0.25, 1 - (3 * p.y() - 0.5));
    EXPECT_LE(cv::norm(color, expected, cv::NORM_INF), 1) << p.transpose();
  });
}

TEST_F(ObjLook, KdMultipliesItsPicture) {
  const TexturedMesh found = squares("newmtl left\nKd 0.5 1 1\nmap_Kd p.png\nnewmtl right\nKd 0.5 1 1\nmap_Kd p.png\n");
  EXPECT_EQ(found.texture.size(), marked_image().size());
  EXPECT_EQ(found.texture.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 128));
  EXPECT_EQ(found.texture.at<cv::Vec3b>(7, 0), cv::Vec3b(255, 0, 0));
  const TexturedMesh black = squares("newmtl left\nKd 0 0 0\nmap_Kd p.png\nnewmtl right\nKd 0 0 0\nmap_Kd p.png\n");
  EXPECT_EQ(cv::norm(black.texture, marked_image(), cv::NORM_INF), 0) << "what some programs write beside every image";
}

TEST_F(ObjLook, WhatClothDoesNotHaveIsRefusedByName) {
  const auto with = [&](const std::string& line) {
    return refused("newmtl left\n" + line + "\nnewmtl right\nKd 1 1 1\n");
  };
  EXPECT_THAT(with("d 0.5"), HasSubstr("m.mtl:2: material \"left\": found d 0.5"));
  EXPECT_THAT(with("Tr 0.5"), HasSubstr("Tr"));
  EXPECT_EQ(with("d 1.0\nTr 1.0"), "") << "d and Tr that mean the same";
  EXPECT_THAT(with("map_Kd -t 1 1 1 p.png"), HasSubstr("-t"));
  EXPECT_THAT(with("map_Kd -mm 0.2 0.5 p.png"), HasSubstr("-mm"));
  EXPECT_THAT(with("map_Kd -sideways 3 p.png"), HasSubstr("-sideways"));
  EXPECT_THAT(with("map_Kd -clamp on -s 2 2 2 p.png"), HasSubstr("-clamp"));
  EXPECT_EQ(with("map_Kd -clamp on p.png"), "");
  EXPECT_THAT(with("map_Kd"), HasSubstr("names no file"));
  EXPECT_THAT(with("Kd spectral light.rfl"), HasSubstr("Kd"));
  EXPECT_THAT(with("map_Kd -s 2 2 p.png\nmap_d p.png"), HasSubstr("map_d lies elsewhere"));
}

TEST_F(ObjLook, HolesThatFollowTrianglesAreOpenAndOthersRefused) {
  cv::Mat image(8, 8, CV_8UC4, cv::Scalar(10, 20, 30, 255));
  image(cv::Rect(0, 0, 8, 4)).setTo(cv::Scalar(0, 0, 0, 0));  // the upper half is a hole
  cv::imwrite(file("holes.png").string(), image);
  text("m.mtl", "newmtl cloth\nmap_Kd holes.png\nmap_d holes.png\n");
  const auto strip = [&](double middle) {
    const std::string y = std::to_string(middle);
    return text("strip.obj", "mtllib m.mtl\nusemtl cloth\nv 0 0 0\nv 1 0 0\nv 0 " + y + " 0\nv 1 " + y +
                                 " 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 " + y + "\nvt 1 " + y +
                                 "\nvt 0 1\nvt 1 1\nf 1/1 2/2 4/4 3/3\nf 3/3 4/4 6/6 5/5\n");
  };
  const TexturedMesh open = read_textured_mesh(strip(0.5));
  EXPECT_EQ(open.mesh.triangles.size(), 2u);
  EXPECT_EQ(open.mesh.vertices.size(), 4u);
  for (const auto& v : open.mesh.vertices) EXPECT_LE(v.y(), 0.5);
  EXPECT_THAT(refusal([&] { read_textured_mesh(strip(0.75)); }), HasSubstr("strip.obj: 2 triangles"));
  cv::imwrite(file("holes.png").string(), cv::Mat(8, 8, CV_8UC4, cv::Scalar(10, 20, 30, 0)));
  EXPECT_THAT(refusal([&] { read_textured_mesh(strip(0.5)); }), HasSubstr("hole everywhere"));
}

TEST_F(ObjLook, TilesShowTheirOwnPictures) {
  cv::imwrite(file("t.1001.png").string(), cv::Mat(4, 4, CV_8UC3, cv::Scalar(0, 0, 200)));
  cv::imwrite(file("t.1012.png").string(), cv::Mat(8, 8, CV_8UC3, cv::Scalar(200, 0, 0)));
  const std::string mesh =
      "mtllib m.mtl\nusemtl cloth\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvt 2 1\nvt 1 2\n"
      "f 1/1 2/2 3/3\nf 1/4 2/5 4/6\n";
  for (const char* name : {"t.<UDIM>.png", "t.1001.png"}) {
    text("m.mtl", std::string("newmtl cloth\nmap_Kd ") + name + "\n");
    const TexturedMesh found = read_textured_mesh(text("a.obj", mesh));
    for_points(found, [&](std::size_t triangle, const Vector3d&, const cv::Vec3b& color) {
      EXPECT_EQ(color, triangle == 0 ? cv::Vec3b(0, 0, 200) : cv::Vec3b(200, 0, 0)) << name;
    });
  }
  std::filesystem::remove(file("t.1012.png"));
  EXPECT_THAT(refusal([&] { read_textured_mesh(file("a.obj")); }), HasSubstr("t.1012.png"));
}

TEST_F(ObjLook, ColoursOfVerticesRunIntoOneAnother) {
  const auto path =
      text("c.obj", "v 0 0 0 0.7 0.3 0.3\nv 1 0 0 0.3 0.7 0.3\nv 1 1 0 0.3 0.3 0.7\nv 0 1 0 0.3 0.7 0.3\nf 1 2 3 4\n");
  const TexturedMesh found = read_textured_mesh(path);
  for_points(
      found,
      [&](std::size_t, const Vector3d& p, const cv::Vec3b& color) {
        // Both triangles share the diagonal from (0, 0) to (1, 1).
        const double x = p.x(), y = p.y(), low = std::min(x, y), high = std::max(x, y);
        const Vector3d rgb = Vector3d::Constant(0.3) + 0.4 * Vector3d(1 - high, high - low, low);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(color[2 - k], 255 * rgb[k], 1.01) << p.transpose();
      },
      Read::bilinear);
}

TEST_F(ObjLook, FacesAreReadHoweverTheyAreWritten) {
  const Mesh expected = read_mesh(text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nv 0 1 0\nf 1 3 4\n"));
  const std::string v = "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\n";
  for (const std::string& text_of :
       {"\xEF\xBB\xBF" + v + "f -3 -2 -1\r\nv 0 1 0\r\nf -4 -2 -1\r\n",
        v + "f 1 \\\r\n 2 \\\r\n 3\r\nv 0 1 0\nf 1// 3// 4//\n",
        std::string("v +0 0 0 1 # a corner\nv 1e0 0 0\nv 1 1 0\nf 1 2 3\nv 0 1 0\nfo 1 3 4")}) {
    const Mesh found = read_mesh(text("b.obj", text_of));
    EXPECT_EQ(found.vertices, expected.vertices) << text_of;
    EXPECT_EQ(found.triangles, expected.triangles) << text_of;
  }
  EXPECT_THAT(refusal([&] { read_mesh(text("b.obj", "v 0,0 0,0 0,0\n")); }), HasSubstr("b.obj:1: found \"0,0"));
  EXPECT_THAT(refusal([&] { read_mesh(text("b.obj", "# a\nv 0 \\\n0 0\nv 1 x 0\n")); }), HasSubstr("b.obj:4"));
  EXPECT_THAT(refusal([&] { read_mesh(text("b.obj", v + "f -4 -2 -1\n")); }), HasSubstr("b.obj:4"));
}

}  // namespace
}  // namespace dressform
