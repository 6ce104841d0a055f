#include "scenes/serialize.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "scenes/camera.h"
#include "scenes/frame.h"
#include "scenes/mesh.h"

namespace dressform {
namespace {

struct Everything {
  Mesh mesh;
  TexturedMesh textured;
  PointCloud cloud;
  Calibration calibration;
  std::vector<Isometry3d> motions;
  std::map<std::string, std::vector<cv::Mat>> images;
  std::vector<std::string> words;
  std::vector<bool> flags;
  std::optional<double> absent, present;
  std::array<Vector3d, 2> corners;
  Eigen::MatrixXd table;
  bool converged = false;
  std::int64_t count = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mesh, textured, cloud, calibration, motions, images, words, flags, absent, present, corners, table,
            converged, count);
  }
};

Everything sample() {
  Everything e;
  e.mesh.vertices = {{1, 2, 3}, {4, 5, 6}, {0.1, 0.2, 0.3}};
  e.mesh.triangles = {{0, 1, 2}};
  e.textured.mesh = e.mesh;
  e.textured.corner_uv = {{Vector2f(0, 1), Vector2f(0.5f, 0.25f), Vector2f(1, 1)}};
  e.textured.texture = cv::Mat(3, 4, CV_8UC3, cv::Scalar(1, 2, 3));
  e.cloud.points = {{1, 1, 1}};
  e.cloud.views = {2};
  e.calibration.sensors["k1"].model = "kinect_v2";
  e.calibration.sensors["k1"].ir = {512, 424, 366, 366, 255, 204, {.1, -.2, 0, 0, .1}};
  e.calibration.sensors["k1"].color = Camera{1920, 1080, 1060, 1060, 950, 540, {}};
  e.calibration.sensors["handheld"].color_from_ir = Isometry3d(Eigen::Translation3d(1, 2, 3));
  e.motions = {Isometry3d(Eigen::AngleAxisd(1, Vector3d::UnitY())), Isometry3d::Identity()};
  e.images["k1"] = {cv::Mat(2, 2, CV_16U, cv::Scalar(700)), cv::Mat(5, 1, CV_32FC2, cv::Scalar(1, 2)), cv::Mat(),
                    cv::Mat(4, 6, CV_64FC3, cv::Scalar(1, 2, 3))(cv::Rect(1, 1, 3, 2))};
  e.words = {"", "neck", std::string("nul\0inside", 10)};
  e.flags = {true, false, true};
  e.present = 4.5;
  e.corners = {Vector3d(1, 2, 3), Vector3d(4, 5, 6)};
  e.table = Eigen::MatrixXd::Random(3, 2);
  e.converged = true;
  e.count = -7;
  return e;
}

TEST(Serialize, EverythingComesBack) {
  const Everything in = sample();
  const auto out = from_bytes<Everything>(to_bytes(in));
  EXPECT_EQ(out.mesh.vertices, in.mesh.vertices);
  EXPECT_EQ(out.mesh.triangles, in.mesh.triangles);
  EXPECT_EQ(out.textured.corner_uv, in.textured.corner_uv);
  EXPECT_EQ(cv::norm(out.textured.texture, in.textured.texture, cv::NORM_INF), 0);
  EXPECT_EQ(out.cloud.views, in.cloud.views);
  EXPECT_EQ(out.calibration.sensors.size(), 2u);
  EXPECT_EQ(out.calibration.sensors.at("k1").color->width, 1920);
  EXPECT_FALSE(out.calibration.sensors.at("handheld").color);
  EXPECT_EQ(out.calibration.sensors.at("handheld").color_from_ir.matrix(),
            in.calibration.sensors.at("handheld").color_from_ir.matrix());
  EXPECT_EQ(out.motions[0].matrix(), in.motions[0].matrix());
  ASSERT_EQ(out.images.at("k1").size(), 4u);
  for (int i : {0, 1, 3}) {
    EXPECT_EQ(out.images.at("k1")[i].type(), in.images.at("k1")[i].type());
    EXPECT_EQ(cv::norm(out.images.at("k1")[i], in.images.at("k1")[i], cv::NORM_INF), 0);
  }
  EXPECT_TRUE(out.images.at("k1")[2].empty());
  EXPECT_EQ(out.words, in.words);
  EXPECT_EQ(out.flags, in.flags);
  EXPECT_FALSE(out.absent);
  EXPECT_EQ(out.present, 4.5);
  EXPECT_EQ(out.corners, in.corners);
  EXPECT_EQ(out.table, in.table);
  EXPECT_TRUE(out.converged);
  EXPECT_EQ(out.count, -7);
}

TEST(Serialize, SameValueSameBytes) {
  EXPECT_EQ(to_bytes(sample()).size(), to_bytes(from_bytes<Everything>(to_bytes(sample()))).size());
  Everything value = sample();
  EXPECT_EQ(to_bytes(value), to_bytes(from_bytes<Everything>(to_bytes(value))));
}

TEST(Serialize, EveryTruncationThrows) {
  const std::string bytes = to_bytes(sample());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(from_bytes<Everything>(bytes.substr(0, size)), std::runtime_error) << size;
  EXPECT_THROW(from_bytes<Everything>(bytes + "x"), std::runtime_error);
}

TEST(Serialize, DamageNeverCrashes) {
  const std::string bytes = to_bytes(sample());
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (unsigned char damage : {0x00, 0x7f, 0x80, 0xff}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damage);
      try {
        from_bytes<Everything>(damaged);
      } catch (const std::runtime_error&) {
      }
    }
}

TEST(Serialize, AbsurdCountsAreRefusedBeforeAllocation) {
  const std::string huge(8, '\x7f');
  EXPECT_THROW(from_bytes<std::vector<Vector3d>>(huge), std::runtime_error);
  EXPECT_THROW(from_bytes<std::vector<Mesh>>(huge), std::runtime_error);
  EXPECT_THROW(from_bytes<std::string>(huge), std::runtime_error);
  EXPECT_THROW(from_bytes<cv::Mat>(std::string(12, '\x01')), std::runtime_error);
  EXPECT_THROW(from_bytes<Eigen::MatrixXd>(huge + huge), std::runtime_error);
}

TEST(Serialize, VectorsOfPointsAreRawBlocks) {
  const std::vector<Vector3d> points(1000, Vector3d(1, 2, 3));
  EXPECT_EQ(to_bytes(points).size(), 8 + 1000 * 24u);
  EXPECT_EQ(from_bytes<std::vector<Vector3d>>(to_bytes(points)), points);
}

}  // namespace
}  // namespace dressform
