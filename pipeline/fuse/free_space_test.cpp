#include "pipeline/fuse/free_space.h"

#include <gtest/gtest.h>

#include "pipeline/fuse/fuse.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/testing/fuse_scans.h"

namespace dressform {
namespace {

using fuse_test::median_error_m;
using test_scene::Figure;
using test_scene::Scan;

// A block 30 cm deep in front of a sensor that sees its front 1.7 m away, but for a slit through which it sees the
// wall.
struct SlitScene {
  SensorCalibration calibration = test_scene::kinect(0.5);
  DepthScan scan;
  std::vector<Isometry3d> model_from_frame{3, Isometry3d::Identity()};
  std::vector<char> used{1, 1, 0};
  Lattice lattice = make_lattice({-0.15, -0.15, 1.7}, {0.15, 0.15, 2.0}, 0.03, 0.01);
  std::vector<float> field;
  static constexpr double kHalfSlit_m = 0.045;

  SlitScene() {
    const cv::Mat rays = normalized_grid(calibration.ir);
    cv::Mat depth(rays.size(), CV_16U, cv::Scalar(1700));
    for (int y = 0; y < rays.rows; ++y)
      for (int x = 0; x < rays.cols; ++x)
        if (std::abs(rays.at<cv::Vec2d>(y, x)[0]) < kHalfSlit_m / 1.7) depth.at<std::uint16_t>(y, x) = 3500;
    scan.depth_mm.assign(3, depth);
    for (std::size_t i = 0; i < lattice.count(); ++i) {
      const Vector3d off = (lattice.point(i) - Vector3d(0, 0, 1.85)).cwiseAbs() - Vector3d::Constant(0.15);
      field.push_back(static_cast<float>(off.maxCoeff()));
    }
  }
  Carved result(const PointCloud& measured, int least_views) const {
    FreeSpaceOptions options;
    options.least_views = least_views;
    return carved(lattice, field, measured, {scan, calibration, model_from_frame, used}, options);
  }
};

TEST(FreeSpace, TakesOutWhatWasSeenThrough) {
  const SlitScene scene;
  const auto solid = scene.result({}, 2).field;
  for (std::size_t i = 0; i < solid.size(); ++i) {
    if (scene.field[i] > -0.0101) continue;
    const Vector3d p = scene.lattice.point(i);
    const double slit = SlitScene::kHalfSlit_m * p.z() / 1.7, pixel = p.z() / scene.calibration.ir.fx;
    if (std::abs(p.x()) < slit - pixel) {
      EXPECT_GT(solid[i], 0) << p.transpose();
    }
    if (std::abs(p.x()) > slit + pixel) {
      EXPECT_EQ(solid[i], scene.field[i]) << p.transpose();
    }
  }
  EXPECT_EQ(scene.result({}, 3).points, 0);  // the third frame is not used
}

TEST(FreeSpace, KeepsWhatAMeasuredSurfaceHasInFront) {
  const SlitScene scene;
  PointCloud front;
  for (double x = -0.1; x < 0.1; x += 0.004)
    for (double y = -0.14; y < 0; y += 0.004) {
      front.points.emplace_back(x, y, 1.7);
      front.normals.emplace_back(0, 0, -1);
    }
  const auto solid = scene.result(front, 2).field;
  const auto at = [&](double y, double z) {
    const Vector3d cell = ((Vector3d(0, y, z) - scene.lattice.origin) / 0.01).array().round();
    return solid[scene.lattice.index(static_cast<int>(cell.x()), static_cast<int>(cell.y()),
                                     static_cast<int>(cell.z()))];
  };
  EXPECT_LT(at(-0.07, 1.712), 0);  // behind the surface
  EXPECT_GT(at(0.07, 1.712), 0);   // where none was measured
  EXPECT_GT(at(0.07, 1.90), 0);
}

TEST(FreeSpace, LegsCloseTogetherStayApart) {
  Figure figure;
  figure.parts = {{{0, 1.05, 0}, {.19, .30, .12}, {}},     {{.11, .48, 0}, {.095, .55, .10}, {}},
                  {{-.11, .48, 0}, {.095, .55, .10}, {}},  {{.11, .04, .05}, {.06, .04, .12}, {}},
                  {{-.11, .04, .05}, {.06, .04, .12}, {}}, {{0, 1.45, 0}, {.10, .20, .10}, {}}};
  for (auto& part : figure.parts) part.rotation.setIdentity();
  const SensorCalibration calibration = test_scene::kinect(0.5);
  const Scan scan = test_scene::walk_round(figure, calibration, 80, 390, 1, 5);
  const BodyModel model = Fuse::at("pose_graph").run(scan.scan, calibration, {}, 1);
  EXPECT_EQ(topology(model.body).components, 1);
  EXPECT_EQ(topology(model.body).euler(), 2);
  const Isometry3d model_from_world = model.model_from_frame[40] * scan.world_from_sensor[40].inverse();
  const MeshQuery body(model.body);
  for (double y = 0.35; y < 0.62; y += 0.03)
    EXPECT_GT(body.signed_distance(model_from_world * Vector3d(0, y, 0)), 0) << y;
  EXPECT_LT(median_error_m(model.body, model_from_world.inverse(), figure), 0.002);
}

}  // namespace
}  // namespace dressform
