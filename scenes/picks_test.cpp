#include "scenes/picks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgproc.hpp>

#include "scenes/capture_session.h"
#include "scenes/error.h"
#include "scenes/image_file.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kWidth = 48, kHeight = 27;

// A session of two sensors, one of them with a difficult name, that tests put picks into.
class PicksOfSession : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) /
            ("picks_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(root_);
    CaptureSession session;
    session.name = "small";
    session.sensors = {"k1", "top_k-2.b"};
    session.calibration.emplace();
    for (const auto& name : session.sensors) {
      SensorCalibration& sensor = session.calibration->sensors[name];
      sensor.color = Camera{kWidth, kHeight, 27, 27, 23.5, 13, {}};
      sensor.ir = Camera{32, 26, 23, 23, 15.5, 12.5, {}};
      sensor.color_from_ir.translation() = Vector3d(0.05, 0, 0);
      Shot& shot = session.dressed[name];
      shot.color = cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(1, 2, 3));
      shot.depth_mm = cv::Mat(26, 32, CV_16UC1, cv::Scalar(2000));
    }
    write_capture_session(session_ = root_ / "session", session);
  }
  void TearDown() override { fs::remove_all(root_); }

  void put(const std::string& name, const std::string& text) const {
    const fs::path file = session_ / "picks" / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
  }
  Picks read() const { return read_picks(session_).value(); }

  fs::path root_, session_;
};

const std::string kTriangle = "0.1,1.4,0.05\n-0.1,1.4,0.05\n0,1.4,-0.1\n";

std::string pick_points(const std::string& points) {
  return "<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData>\n  <DateTime date=\"2015-08-01\" "
         "time=\"10:11:12\"/>\n"
         "  <User name=\"me\"/>\n  <DataFileName name=\"top.ply\"/>\n  <templateName name=\"\"/>\n </DocumentData>\n" +
         points + "</PickedPoints>\n";
}

std::string labelme(const std::string& shapes, int width = kWidth, int height = kHeight) {
  return R"({"version": "5.4.1", "flags": {}, "shapes": [)" + shapes +
         R"(], "imagePath": "color.png", "imageData": null, "imageHeight": )" + std::to_string(height) +
         ", \"imageWidth\": " + std::to_string(width) + "}";
}

TEST_F(PicksOfSession, AbsentFolderMeansNone) {
  EXPECT_FALSE(read_picks(session_));
  const std::string nothing = picks_content_hash(session_);
  put("model/rim_top_neck.csv", kTriangle);
  EXPECT_NE(picks_content_hash(session_), nothing);
  fs::remove_all(session_ / "picks");
  EXPECT_EQ(picks_content_hash(session_), nothing);
}

TEST_F(PicksOfSession, WhatIsWrittenReadsBackBitForBit) {
  Picks picks;
  picks.points["rim_top_neck"] = {{"k1", {{0.1, 1.0 / 3, 2}, {-1e-17, 0.25, 2.1}, {0.3, 1e-5, 1.9}}},
                                  {"model", {{0, 1.4, 0}, {0.1, 1.4, 0}, {0.1, 1.4, 0.1}}}};
  picks.points["control"] = {{"scan_naked", std::vector<Vector3d>(5, {0.1, 0.2, 1.9})}};
  picks.points["target"] = {{"scan_user", std::vector<Vector3d>(5, {0.1, 0.2, 1.8})}};
  cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(3, 4, 10, 7)) = 255;
  picks.regions["region_top_top_k-2.b"] = mask;
  write_picks(session_, picks);
  const Picks found = read();
  ASSERT_THAT(found.names(), ElementsAre("control", "rim_top_neck", "target", "region_top_top_k-2.b"));
  for (const auto& [name, parts] : picks.points) {
    ASSERT_EQ(found.points.at(name).size(), parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      EXPECT_EQ(found.points.at(name)[i].frame, parts[i].frame);
      EXPECT_EQ(found.points.at(name)[i].points, parts[i].points) << name;
    }
  }
  EXPECT_EQ(cv::norm(found.regions.at("region_top_top_k-2.b"), mask, cv::NORM_INF), 0);
  EXPECT_THROW(write_picks(session_, picks), InputError);
}

// What MeshLab writes: points of a template that nobody placed are inactive.
TEST_F(PicksOfSession, ReadsMeshLabsPickPoints) {
  put("model/rim_bottom_waist.pp", pick_points(" <point name=\"0\" x=\"0.125\" y=\"1\" z=\"0\" active=\"1\"/>\n"
                                               " <point name=\"1\" x=\"0\" y=\"0\" z=\"0\" active=\"0\"/>\n"
                                               " <point name=\"2\" x=\"0\" y=\"1.0e+00\" z=\"-.25\"/>\n"
                                               " <point name=\"3\" x=\"-0.125\" y=\"1\" z=\"0\" active=\"1\"/>\n"));
  const Picks picks = read();
  const auto& parts = picks.points.at("rim_bottom_waist");
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].frame, "model");
  EXPECT_THAT(parts[0].points, ElementsAre(Vector3d(0.125, 1, 0), Vector3d(0, 1, -0.25), Vector3d(-0.125, 1, 0)));
}

TEST_F(PicksOfSession, ReadsCloudComparesLists) {
  const std::vector<Vector3d> expected{{0.1, 1.4, 0.05}, {-0.1, 1.4, 0.05}, {0, 1.4, -0.1}};
  put("model/rim_top_neck.txt", kTriangle);
  put("model/rim_top_hem.csv",
      "\xEF\xBB\xBF//label,X,Y,Z\r\nPoint #0,0.1,1.4,0.05\r\nPoint #1, -0.1, 1.4, 0.05\r\n\r\n"
      "Point #2,0,+1.4,-0.1");
  put("model/rim_top_left_cuff.asc", "0.1 1.4  0.05\n-0.1\t1.4 0.05\n 0 1.4 -0.1 \n");
  put("model/rim_top_right_cuff.csv", "0;0.1;1.4;0.05\n1;-0.1;1.4;0.05\n2;0;1.4;-0.1\n");
  const Picks picks = read();
  EXPECT_EQ(picks.points.size(), 4u);
  for (const auto& [name, parts] : picks.points) EXPECT_EQ(parts[0].points, expected) << name;
}

// A rectangle of labelme's from (10, 5) to (20, 15) holds the pixels 10 to 19 and 5 to 14, give or take its outline.
TEST_F(PicksOfSession, ReadsLabelmesShapes) {
  const std::string rectangle =
      R"({"label": "LABEL", "points": [[20.0, 5.0], [10.0, 15.0]], "shape_type": "rectangle", "flags": {}})";
  const std::string polygon =
      R"({"label": "smooth_top", "points": [[30, 5], [40, 5], [40, 15], [30, 15]], "shape_type": "polygon"})";
  auto named = [&](std::string label) { return std::string(rectangle).replace(rectangle.find("LABEL"), 5, label); };
  put("top_k-2.b/color.json", labelme(named("region_top") + "," + polygon));
  put("label_skin_k1.json", labelme(named("skin") + "," + named("hand")));
  const Picks picks = read();
  EXPECT_THAT(picks.names(), ElementsAre("label_skin_k1", "region_top_top_k-2.b", "smooth_top_top_k-2.b"));
  for (const auto& [name, mask] : picks.regions) {
    ASSERT_EQ(mask.size(), cv::Size(kWidth, kHeight));
    const int left = name == "smooth_top_top_k-2.b" ? 30 : 10;
    EXPECT_EQ(cv::countNonZero(mask(cv::Rect(left, 5, 10, 10))), 100) << name;
    EXPECT_LE(cv::countNonZero(mask), 11 * 11) << name;
  }
}

TEST_F(PicksOfSession, ReadsMasksWhateverTheyCallInside) {
  cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(1, 2, 3, 4)) = 1;
  fs::create_directories(session_ / "picks");
  write_png(session_ / "picks/smooth_bottom_k1.png", mask);
  EXPECT_EQ(cv::norm(read().regions.at("smooth_bottom_k1"), mask * 255, cv::NORM_INF), 0);
}

// A region whose file cannot be written leaves no half of the others behind.
TEST_F(PicksOfSession, NothingIsHalfWritten) {
  Picks picks;
  picks.points["rim_top_neck"] = {{"model", {{0, 1.4, 0}, {0.1, 1.4, 0}, {0.1, 1.4, 0.1}}}};
  picks.regions["no_such_folder/region_top_k1"] = cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
  const auto before = std::distance(fs::directory_iterator(session_), {});
  EXPECT_ANY_THROW(write_picks(session_, picks));
  EXPECT_EQ(std::distance(fs::directory_iterator(session_), {}), before);
}

TEST(PickedRegion, IsAsLargeAsItsImageOrNone) {
  Picks picks;
  picks.regions["region_top_k1"] = cv::Mat(6, 8, CV_8UC1, cv::Scalar(255));
  EXPECT_EQ(cv::countNonZero(picked_region(picks, "region_top_k1", {8, 6})), 48);
  EXPECT_TRUE(picked_region(picks, "region_bottom_k1", {8, 6}).empty());
  try {
    picked_region(picks, "region_top_k1", {6, 8});
    ADD_FAILURE() << "a region of another size was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("picks: region_top_k1"));
    EXPECT_THAT(error.what(), HasSubstr("is 8 x 6; expected the colour image's size, 6 x 8"));
  }
}

TEST_F(PicksOfSession, PicksChangeNothingElse) {
  const std::string without = session_content_hash(session_);
  put("model/rim_top_neck.txt", kTriangle);
  EXPECT_EQ(session_content_hash(session_), without);
  EXPECT_EQ(read_capture_session(session_).dressed.size(), 2u);
  put("model/nonsense.txt", "?");
  EXPECT_EQ(session_content_hash(session_), without);
  EXPECT_EQ(read_capture_session(session_).dressed.size(), 2u);
}

TEST_F(PicksOfSession, WhatCannotBeMeantIsNamed) {
  const std::string shape = R"({"label": "region_top", "points": [[1, 1], [9, 1], [9, 9]], "shape_type": "polygon"})";
  const struct {
    const char* file;
    std::string text, where, problem;
  } cases[] = {
      {"model/rim_top_neck.pp", "", "rim_top_neck.pp:1", "is not XML"},
      {"model/rim_top_neck.pp", pick_points("").substr(0, 200), "rim_top_neck.pp:", "is not XML"},
      {"model/rim_top_neck.pp", "<Other/>", "rim_top_neck.pp:1", "expected PickedPoints"},
      {"model/rim_top_neck.pp", pick_points(""), "rim_top_neck.pp", "found 0 points; expected 3"},
      {"model/rim_top_neck.pp", pick_points("<point x=\"1\" y=\"2\"/>\n"), "rim_top_neck.pp:9", "without z"},
      {"model/rim_top_neck.pp",
       pick_points("<point x=\"1\" y=\"1\" z=\"0\"/>\n\n<point active=\"0\"/>\n<point x=\"1\" y=\"2\"/>\n"),
       "rim_top_neck.pp:12", "without z"},
      {"model/rim_top_neck.pp", pick_points("<point x=\"1\" y=\"nan\" z=\"0\"/>\n"), "rim_top_neck.pp:9",
       "y = \"nan\""},
      {"model/rim_top_neck.pp", pick_points("<point x=\"1,5\" y=\"1\" z=\"0\"/>\n"), "rim_top_neck.pp:9", "\"1,5\""},
      {"model/rim_top_neck.txt", "1,2\n", "rim_top_neck.txt:1", "found 2 columns"},
      {"model/rim_top_neck.txt", "0,1,0\n0,1,0,0\n", "rim_top_neck.txt:2", "expected 3 as in"},
      {"model/rim_top_neck.txt", "0,1,0\n0,one,0\n", "rim_top_neck.txt:2", "\"one\""},
      {"model/rim_top_neck.txt", "0;1,5;0;0\n", "rim_top_neck.txt:1", "found 2 columns"},
      {"model/rim_top_neck.txt", "0 1e999 0\n", "rim_top_neck.txt:1", "finite"},
      {"model/rim_top_neck.txt", "0,1400,0\n1,1400,0\n0,1400,1\n", "rim_top_neck.txt", "looks like millimetres"},
      {"k1/rim_top_neck.txt", kTriangle, "rim_top_neck.txt", "z forward"},
      {"k1/rim_top_neck.txt", "0 0 -2\n1 0 -2\n0 1 -2\n", "rim_top_neck.txt", "before the infrared camera \"k1\""},
      {"k9/rim_top_neck.txt", kTriangle, "k9", "expected model, user"},
      {"model/rim_top_knee.txt", kTriangle, "rim_top_knee.txt", "neck, left_cuff"},
      {"model/rim_hat_neck.txt", kTriangle, "rim_hat_neck.txt", "expected rim_<top|bottom>"},
      {"user/rim_top_neck.txt", kTriangle, "rim_top_neck.txt", "points of the mannequin"},
      {"model/target.txt", kTriangle + kTriangle, "target.txt", "picks/user"},
      {"model/control.txt", kTriangle + kTriangle, "picks", "6 points named control and 0 named target"},
      {"model/rim_top_neck.obj", kTriangle, "rim_top_neck.obj", "another kind"},
      {"model/color.json", labelme(shape), "color.json", "another kind"},
      {"region_top.png", "", "region_top.png", "<region>_<sensor>"},
      {"region_top_k9.png", "", "region_top_k9.png", "k1, top_k-2.b"},
      {"region_top_k1.png", "", "region_top_k1.png", "no PNG"},
      {"k1/color.json", "{", "color.json", "is not JSON"},
      {"k1/color.json", labelme(""), "shapes", "found none"},
      {"k1/color.json", labelme(shape, 96, 54), "imageWidth", "found 96; expected 48"},
      {"k1/color.json", labelme(std::string(shape).replace(shape.find("[9, 1]"), 6, "[90, 1]")), "shapes[0].points[1]",
       "inside the image"},
      {"k1/color.json", labelme(std::string(shape).replace(shape.find("polygon"), 7, "circle")), "shape_type",
       "polygon or rectangle"},
      {"k1/color.json", labelme(std::string(shape).replace(shape.find("region_top"), 10, "shirt")), "shapes",
       "label_skin"},
      {"k1/color.json", std::string(5000, '[') + std::string(5000, ']'), "color.json", "nested"},
  };
  for (const auto& each : cases) {
    SCOPED_TRACE(std::string(each.file) + ": " + each.problem);
    fs::remove_all(session_ / "picks");
    put(each.file, each.text);
    try {
      read();
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.where(), HasSubstr(each.where));
      EXPECT_THAT(error.what(), HasSubstr(each.problem));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

TEST_F(PicksOfSession, NothingIsPickedTwice) {
  put("model/rim_top_neck.txt", kTriangle);
  put("model/rim_top_neck.csv", kTriangle);
  EXPECT_THROW(read(), InputError);
  fs::remove_all(session_ / "picks");
  const std::string shape = R"({"label": "region_top", "points": [[1, 1], [9, 1], [9, 9]], "shape_type": "polygon"})";
  put("region_top_k1.json", labelme(shape));
  put("k1/color.json", labelme(shape));
  EXPECT_THROW(read(), InputError);
}

TEST_F(PicksOfSession, NoLinkLeadsOut) {
  std::ofstream(root_ / "secret.txt") << kTriangle;
  fs::create_directories(session_ / "picks/model");
  fs::create_symlink(root_ / "secret.txt", session_ / "picks/model/rim_top_neck.txt");
  EXPECT_THROW(read(), InputError);
}

}  // namespace
}  // namespace dressform
