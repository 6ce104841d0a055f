#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "pipeline/extract/extract.h"
#include "pipeline/extract/naked_stance.h"
#include "pipeline/testing/analytic_scene.h"
#include "pipeline/testing/figure.h"

namespace dressform {
namespace {

// The side of a figure that a sensor at +z sees, in the frame of a sensor that stands before it, looks at it level, and
// sees it turned and to one side.
TEST(ModelStance, FindsAFigureThatIsTurnedAndToOneSide) {
  const Mesh figure = make_figure({}, 0.02);
  const MeshQuery model(figure);
  Isometry3d sensor_from_model(Eigen::AngleAxisd(M_PI, Vector3d::UnitX()));  // x right, y down, z forward
  sensor_from_model.translation() = Vector3d(0.15, 1.2, 2.0);
  const Isometry3d truth = sensor_from_model * Isometry3d(Eigen::AngleAxisd(0.6, Vector3d::UnitY()));
  const Vector3d eye = truth.inverse().translation();
  std::vector<Vector3d> points;
  for (const Vector3d& v : figure.vertices) {
    const auto hit = model.first_hit(eye, v - eye);
    if (hit && hit->distance > 0.999) points.push_back(truth * v);
  }
  ASSERT_GT(points.size(), 1000u);
  const auto found = model_stance(points, {0, -1, 0}, Eigen::Vector4d(0, -1, 0, 1.2), model);
  ASSERT_TRUE(found);
  const Isometry3d error = *found * truth;
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.2);  // a hand is half a metre off the axis
  EXPECT_LT((error * Vector3d(0, 1, 0) - Vector3d(0, 1, 0)).norm(), 0.03);
  const auto floorless = model_stance(points, {0, -1, 0}, {}, model);
  ASSERT_TRUE(floorless);
  EXPECT_LT((*floorless * truth * Vector3d(0, 1, 0) - Vector3d(0, 1, 0)).norm(), 0.05);
  EXPECT_FALSE(model_stance({points.begin(), points.begin() + 20}, {0, -1, 0}, {}, model));
}

// A post beside the torso, nearer to the mannequin than a room's furniture, and 20 cm off its arms.
cv::Mat add_post(const analytic::AnalyticScene& scene, Shot& shot) {
  const Camera& ir = scene.calibration.sensors.at("k1").ir;
  const Isometry3d& pose = scene.registration.model_from_sensor.at("k1");
  cv::Mat post = cv::Mat::zeros(shot.depth_mm.size(), CV_8U);
  shot.depth_mm = shot.depth_mm.clone();
  for (int y = 0; y < post.rows; ++y)
    for (int x = 0; x < post.cols; ++x) {
      const Vector3d p = pose * ir.unproject(Vector2d(x, y), 2.1);
      if (p.x() < 0.54 || p.x() > 0.64 || p.y() < 1.05 || p.y() > 1.4) continue;
      shot.depth_mm.at<ushort>(y, x) = 2100;
      post.at<uchar>(y, x) = 255;
    }
  return post;
}

TEST(ClusterNaked, LeavesOutWhatStandsFarOffTheModel) {
  auto scene = analytic::make_scene();
  const cv::Mat post = add_post(scene, scene.session.naked.at("k1"));
  add_post(scene, scene.session.dressed.at("k1"));
  ASSERT_GT(cv::countNonZero(post), 40);
  const auto run = [&](const char* variant) {
    return Extract::at(variant).run(scene.session, scene.calibration, scene.naked, {}, 1).views.at("k1");
  };
  const ViewMasks with = run("cluster"), without = run("cluster_naked");
  EXPECT_GT(cv::countNonZero(with.dressed & post), 0.9 * cv::countNonZero(post)) << "the post is no trap";
  EXPECT_EQ(cv::countNonZero(without.dressed & post), 0);
  EXPECT_EQ(cv::countNonZero(without.naked & post), 0);
  EXPECT_LT(cv::countNonZero((with.dressed & ~post) & ~without.dressed), 0.005 * cv::countNonZero(with.dressed))
      << "some of the mannequin went with it";
}

// The blue shirt is not of the wall's colour: its outline is where the image has it, in either band.
TEST(ClusterGrabcut, DrawsTheShirtsOutlineAndGivesTheSameTwice) {
  const auto scene = analytic::make_scene();
  const auto run = [&](double band_px) {
    return Extract::at("cluster_grabcut")
        .run(scene.session, scene.calibration, scene.naked, {{"band_px", band_px}}, 1)
        .views.at("k1");
  };
  const ViewMasks narrow = run(6), wide = run(24);
  const cv::Mat shirt = scene.labels.at("k1") == 2;
  for (const ViewMasks* masks : {&narrow, &wide})
    EXPECT_GT(cv::countNonZero(masks->dressed_color & shirt), 0.95 * cv::countNonZero(shirt));
  EXPECT_GT(cv::norm(narrow.dressed_color, wide.dressed_color, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(narrow.dressed_color, run(6).dressed_color, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace dressform
