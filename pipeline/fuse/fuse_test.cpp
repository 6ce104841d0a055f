#include "pipeline/fuse/fuse.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "pipeline/fuse/block_volume.h"
#include "pipeline/fuse/body_points.h"
#include "pipeline/fuse/closed_body.h"
#include "pipeline/fuse/free_space.h"
#include "pipeline/fuse/fuse_scan.h"
#include "pipeline/fuse/model_volume.h"
#include "pipeline/fuse/track.h"
#include "pipeline/fuse/turning.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/testing/figure.h"
#include "pipeline/testing/test_scene.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

using test_scene::Figure;
using test_scene::Scan;

constexpr double kDegrees = 180 / M_PI;

// Largest error of a pose relative to the middle frame: at the figure's centre, and of the rotation.
struct PoseErrors {
  double largest_m = 0, largest_deg = 0;
};
PoseErrors pose_errors(const std::vector<Isometry3d>& found, const std::vector<Isometry3d>& truth) {
  const std::size_t middle = truth.size() / 2;
  const Isometry3d world = truth[middle] * found[middle].inverse();
  PoseErrors errors;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!found[i].matrix().allFinite()) continue;
    const Isometry3d error = truth[i] * (world * found[i]).inverse();
    const Vector3d centre(0, 1, 0);
    errors.largest_m = std::max(errors.largest_m, (error * centre - centre).norm());
    errors.largest_deg = std::max(errors.largest_deg, kDegrees * Eigen::AngleAxisd(error.linear()).angle());
  }
  return errors;
}

double median_error_m(const Mesh& body, const Isometry3d& world_from_model, const Figure& figure) {
  std::vector<double> errors;
  for (const auto& p : body.vertices) errors.push_back(std::abs(test_scene::distance_to(figure, world_from_model * p)));
  return median(std::move(errors));
}

const Scan& noisy_scan() {
  static const Scan scan =
      test_scene::walk_round(test_scene::standing_figure(), test_scene::kinect(0.25, -0.015), 120, 390, 1, 7);
  return scan;
}

TEST(AlignFrames, RecoversAKnownMotion) {
  const SensorCalibration calibration = test_scene::kinect(0.5);
  const Scan scan = test_scene::walk_round(test_scene::standing_figure(), calibration, 3, 6, 0, 1);
  const ScanFrames frames = prepare_frames(scan.scan, calibration, 30, 4.5);
  const Projector projector(frames.maps[0].camera);
  Vector6d off;
  off << 0.02, -0.01, 0.015, 0.02, -0.015, 0.01;
  const auto found = align_to_frames(frames, projector, 1, {0, 2}, scan.world_from_sensor,
                                     exponential(off) * scan.world_from_sensor[1], {{0.1, 0.6, 1}, {0.02, 0.8, 1}}, 15);
  ASSERT_TRUE(found.converged);
  const Isometry3d error = scan.world_from_sensor[1].inverse() * found.world_from_frame;
  EXPECT_LT(error.translation().norm(), 0.002);
  EXPECT_LT(kDegrees * Eigen::AngleAxisd(error.linear()).angle(), 0.06);
}

TEST(AlignFrames, DoesNotConvergeOnNothing) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  Scan scan = test_scene::walk_round(test_scene::standing_figure(), calibration, 2, 6, 0, 1);
  const ScanFrames frames = prepare_frames(scan.scan, calibration, 30, 4.5);
  const Isometry3d away = scan.world_from_sensor[0] * Eigen::AngleAxisd(M_PI, Vector3d::UnitY());
  EXPECT_FALSE(align_to_frames(frames, Projector(frames.maps[0].camera), 1, {0}, scan.world_from_sensor, away,
                               {{0.02, 0.8, 1}}, 5)
                   .converged);
}

TEST(Track, WalkRoundIsFollowedAndItsLoopClosed) {
  const SensorCalibration calibration = test_scene::kinect(0.25, -0.015);
  const ScanFrames frames = prepare_frames(noisy_scan().scan, calibration, 30, 4.5);
  const Projector projector(frames.maps[0].camera);
  const Track open = track_odometry(frames, projector);
  EXPECT_EQ(open.count_tracked(), 120);
  const Track closed = close_loop(frames, projector, open);
  EXPECT_TRUE(closed.loop_found);
  EXPECT_GT(closed.loop_closure_m, 0);
  EXPECT_LT(pose_errors(closed.world_from_frame, noisy_scan().world_from_sensor).largest_m, 0.02);
  EXPECT_LT((axes_crossing(closed) - closed.world_from_frame[0] * Vector3d(0, 0, 1.9)).norm(), 0.15);
}

// A sensor that stands still before a figure that turns: seen from the figure, the sensor walks and the room turns.
Scan turning_figure(int frames, double turn_deg, double noise) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  const cv::Mat rays = normalized_grid(calibration.ir);
  Scan result;
  result.scan.sensor = "handheld";
  Figure room = test_scene::standing_figure();
  room.parts.clear();
  room.wall_m = 1.6;
  const Isometry3d eye = test_scene::looking_at({0, 1.15, 1.55}, {0, 0.95, 0});  // in the room, the wall 3.1 m away
  const cv::Mat still = test_scene::depth_image(room, calibration, rays, eye, 0, 1);
  for (int i = 0; i < frames; ++i) {
    const Isometry3d figure_from_room(Eigen::AngleAxisd(turn_deg * M_PI / 180 * i / (frames - 1), Vector3d::UnitY()));
    Figure alone = test_scene::standing_figure();
    alone.wall_m = 0;
    alone.floor = false;
    result.world_from_sensor.push_back(figure_from_room * eye);
    cv::Mat depth = test_scene::depth_image(alone, calibration, rays, result.world_from_sensor.back(), noise, 100 + i);
    for (int y = 0; y < depth.rows; ++y)
      for (int x = 0; x < depth.cols; ++x) {
        auto& z = depth.at<std::uint16_t>(y, x);
        const int wall = still.at<std::uint16_t>(y, x);
        if (wall > 0 && (z == 0 || wall < z))
          z = static_cast<std::uint16_t>(wall + std::lround(noise * normal4(9, i, y * depth.cols + x)[0]));
      }
    result.scan.depth_mm.push_back(depth);
  }
  return result;
}

TEST(Turning, WhoTurnsBeforeAWallIsTheBody) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  const Scan scan = turning_figure(120, 370, 1);
  const auto limit_m = depth_of_moving(scan.scan, calibration);
  ASSERT_TRUE(limit_m);
  EXPECT_GT(*limit_m, 1.7);
  EXPECT_LT(*limit_m, 2.6);
  const BodyModel model = Fuse::at("pose_graph").run(scan.scan, calibration, {}, 1);
  EXPECT_TRUE(model.converged) << model.note;
  EXPECT_GT(model.turned_deg, 330);
  EXPECT_NE(model.note.find("that was taken for the body"), std::string::npos) << model.note;
  const Isometry3d world_from_model = scan.world_from_sensor[60] * model.model_from_frame[60].inverse();
  EXPECT_LT(median_error_m(model.body, world_from_model, test_scene::standing_figure()), 0.008);
}

TEST(Turning, WhereNothingTurnedThatIsSaid) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  const Scan scan = test_scene::walk_round(test_scene::standing_figure(), calibration, 20, 7, 1, 3);
  EXPECT_FALSE(depth_of_moving(scan.scan, calibration));
  const BodyModel model = Fuse::at("pose_graph").run(scan.scan, calibration, {}, 1);
  EXPECT_FALSE(model.converged);
  EXPECT_NEAR(model.turned_deg, 7, 3);
  EXPECT_NE(model.note.find("nothing turned"), std::string::npos) << model.note;
}

TEST(Turning, AWalkRoundIsAWalkRound) {
  EXPECT_FALSE(depth_of_moving(noisy_scan().scan, test_scene::kinect(0.25, -0.015)));
}

// A bust, scanned all round: shoulders are no floor.
TEST(FuseVariants, ABustHasNoFloor) {
  Figure bust = test_scene::standing_figure();
  bust.parts = {bust.parts[0], bust.parts[2], bust.parts[3], bust.parts[4], bust.parts[5]};
  bust.floor = false;
  const SensorCalibration calibration = test_scene::kinect(0.25);
  const Scan scan = test_scene::walk_round(bust, calibration, 120, 390, 1, 7);
  const BodyModel model = Fuse::at("pose_graph").run(scan.scan, calibration, {}, 1);
  EXPECT_FALSE(model.floor_seen);
  EXPECT_NE(model.note.find("no floor was seen"), std::string::npos) << model.note;
  ASSERT_FALSE(model.body.triangles.empty());
  const Isometry3d world_from_model = scan.world_from_sensor[60] * model.model_from_frame[60].inverse();
  EXPECT_LT(median_error_m(model.body, world_from_model, bust), 0.008);
}

TEST(BlockVolume, SphereFromKnownPoses) {
  Figure ball;
  ball.parts = {{{0, 1, 0}, {.3, .3, .3}}};
  ball.floor = false;
  const SensorCalibration calibration = test_scene::kinect(0.5, 0.01);
  const Scan scan = test_scene::walk_round(ball, calibration, 30, 350, 1, 3);
  const ScanFrames frames = prepare_frames(scan.scan, calibration, 30, 4.5);
  const std::vector<char> used(30, 1);
  const BlockVolume volume(frames, calibration.ir, scan.world_from_sensor, used, {}, {});
  const PointCloud points = volume.surface_points(3);
  ASSERT_GT(points.points.size(), 10000u);
  double sum = 0;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const Vector3d outward = points.points[i] - Vector3d(0, 1, 0);
    sum += outward.norm() - 0.3;
    EXPECT_LT(std::abs(outward.norm() - 0.3), 0.008);
    EXPECT_GT(outward.normalized().dot(points.normals[i]), 0.5);
  }
  EXPECT_LT(std::abs(sum / points.points.size()), 3e-4);
}

// What the model of a ball shows from a place where no frame was taken.
TEST(ModelVolume, RayCastOfASphere) {
  Figure ball;
  ball.parts = {{{0, 1, 0}, {.3, .3, .3}}};
  ball.floor = false;
  ball.wall_m = 0;
  const SensorCalibration calibration = test_scene::kinect(0.5);
  const Scan scan = test_scene::walk_round(ball, calibration, 12, 40, 1, 3);
  const ScanFrames frames = prepare_frames(scan.scan, calibration, 30, 4.5);
  VolumeOptions options;
  options.voxel_m = 0.01;
  options.truncation_m = 0.04;
  ModelVolume model(calibration.ir, options);
  for (int i = 0; i < 12; ++i)
    if (i != 6) model.integrate(frames.depth_m[i], frames.maps[i], scan.world_from_sensor[i]);
  const Camera grid = frames.maps[0].camera;
  const Isometry3d& pose = scan.world_from_sensor[6];
  const DepthMap seen = model.ray_cast(grid, normalized_grid(grid), pose);
  EXPECT_GT(seen.valid, 0.8 * frames.maps[6].valid);
  double off = 0, turned = 0;
  for (std::size_t k = 0; k < seen.points.size(); ++k) {
    if (!seen.has_normal(static_cast<int>(k))) continue;
    const Vector3d outward = pose * seen.points[k].cast<double>() - Vector3d(0, 1, 0);
    off += std::abs(outward.norm() - 0.3) / seen.valid;
    turned += kDegrees *
              std::acos(std::min(1.0, outward.normalized().dot(pose.linear() * seen.normals[k].cast<double>()))) /
              seen.valid;
    EXPECT_LT(std::abs(outward.norm() - 0.3), 0.01);
  }
  EXPECT_LT(off, 0.0015);
  EXPECT_LT(turned, 8);
  // From behind, where nothing was seen, there is nothing.
  const Isometry3d behind = Isometry3d(Eigen::AngleAxisd(M_PI, Vector3d::UnitY())) * pose;
  EXPECT_LT(model.ray_cast(grid, normalized_grid(grid), behind).valid, 0.01 * seen.valid);
}

// Figure 3.35 of the thesis: a body without head, neck, hands and feet, closed.
TEST(BodySurface, EndsAreCutOffAndClosed) {
  const Mesh figure = make_figure({});
  const PointCloud cloud{figure.vertices, vertex_normals(figure), {}, {}};
  const DepthScan nothing;
  const SensorCalibration calibration = test_scene::kinect(0.25);
  ClosedBodyOptions options;
  options.cut_ends = true;
  const Mesh cut = closed_body(cloud, options, {nothing, calibration, {}, {}});
  const Topology shape = topology(cut);
  EXPECT_TRUE(shape.closed());
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.euler(), 2);
  const MeshQuery body(cut);
  for (const Vector3d& gone : {Vector3d(0, 1.68, 0), Vector3d(0, 1.54, 0), Vector3d(.36, .80, 0),
                               Vector3d(-.36, .80, 0), Vector3d(.09, .03, .10), Vector3d(-.09, .03, .10)})
    EXPECT_GT(body.signed_distance(gone), 0.01) << gone.transpose();
  for (const Vector3d& stays : {Vector3d(0, 1.2, 0), Vector3d(.09, .3, 0), Vector3d(-.09, .3, 0),
                                Vector3d(.29, 1.06, 0), Vector3d(-.29, 1.06, 0), Vector3d(0, 1.38, 0)})
    EXPECT_LT(body.signed_distance(stays), -0.02) << stays.transpose();
}

TEST(BodySurface, ClosesSolesAndLeavesOutWhatStandsApart) {
  PointCloud cloud;
  const auto add_ball = [&](const Vector3d& centre, double radius) {
    for (int i = 0; i < 20000; ++i) {
      const auto n = normal4(3, 4, i);
      const Vector3d out = Vector3d(n[0], n[1], n[2]).normalized();
      const Vector3d p = centre + radius * out;
      if (p.y() < 0.001) continue;
      cloud.points.push_back(p);
      cloud.normals.push_back(out);
    }
  };
  add_ball({0, 0.2, 0}, 0.25);   // cut by the floor: its underside is never seen
  add_ball({0.6, 0.2, 0}, 0.1);  // a pot beside it
  const PointCloud body = body_points(cloud, 0, 0, {});
  for (const auto& p : body.points) EXPECT_LT(p.x(), 0.3);
  const DepthScan nothing;
  const SensorCalibration calibration = test_scene::kinect(0.25);
  const ScanViews views{nothing, calibration, {}, {}};
  const Mesh mesh = closed_body(body, {}, views);
  const Topology shape = topology(mesh);
  EXPECT_TRUE(shape.closed());
  EXPECT_EQ(shape.euler(), 2);
  for (const auto& p : mesh.vertices) EXPECT_GT(p.y(), -0.01);
  EXPECT_TRUE(closed_body({}, {}, views).triangles.empty());
}

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

class EveryFuse : public testing::TestWithParam<std::string> {};

TEST_P(EveryFuse, BodyOfAWalkRound) {
  const SensorCalibration calibration = test_scene::kinect(0.25, -0.015);
  const BodyModel model = Fuse::at(GetParam()).run(noisy_scan().scan, calibration, {}, 1);
  EXPECT_TRUE(model.converged);
  EXPECT_EQ(model.frames_used, 120);
  ASSERT_EQ(model.model_from_frame.size(), 120u);
  const bool best = GetParam() == "pose_graph";
  const PoseErrors errors = pose_errors(model.model_from_frame, noisy_scan().world_from_sensor);
  EXPECT_LT(errors.largest_m, best ? 0.003 : 0.03);
  EXPECT_LT(errors.largest_deg, best ? 0.3 : 2.0);
  const Isometry3d world_from_model = noisy_scan().world_from_sensor[60] * model.model_from_frame[60].inverse();
  EXPECT_LT(median_error_m(model.body, world_from_model, test_scene::standing_figure()), best ? 0.002 : 0.006);
  EXPECT_LT(kDegrees * std::acos((world_from_model.linear() * Vector3d::UnitY()).y()), best ? 0.15 : 1);  // gravity
  EXPECT_LT(std::abs(world_from_model.translation().y()), best ? 0.002 : 0.02);                           // floor y = 0
  EXPECT_LT((world_from_model * Vector3d(0, 0, 0)).norm(), 0.05);                                         // axis
  EXPECT_TRUE(topology(model.body).closed());
  EXPECT_EQ(topology(model.body).components, 1);
  EXPECT_GT(model.surroundings.points.size(), 10000u);
}

TEST_P(EveryFuse, SameBytesWithOneAndTwoThreads) {
  const SensorCalibration calibration = test_scene::kinect(0.25, -0.015);
  DepthScan scan = noisy_scan().scan;
  scan.depth_mm.resize(20);
  std::vector<BodyModel> models;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    models.push_back(Fuse::at(GetParam()).run(scan, calibration, {}, 1));
  }
  EXPECT_EQ(models[1].body.vertices, models[0].body.vertices);
  EXPECT_EQ(models[1].body.triangles, models[0].body.triangles);
  EXPECT_EQ(models[1].surroundings.points, models[0].surroundings.points);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_EQ(models[1].model_from_frame[i].matrix(), models[0].model_from_frame[i].matrix());
}

TEST_P(EveryFuse, DroppedFramesHaveNoPose) {
  const SensorCalibration calibration = test_scene::kinect(0.25, -0.015);
  DepthScan scan = noisy_scan().scan;
  scan.depth_mm.resize(30);
  scan.depth_mm[11] = scan.depth_mm[12] = cv::Mat::zeros(scan.depth_mm[0].size(), CV_16U);
  const BodyModel model = Fuse::at(GetParam()).run(scan, calibration, {}, 1);
  EXPECT_EQ(model.frames_used, 28);
  EXPECT_FALSE(model.model_from_frame[11].matrix().allFinite());
  EXPECT_TRUE(model.model_from_frame[13].matrix().allFinite());
}

TEST_P(EveryFuse, RefusesAScanWithoutDepth) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  DepthScan scan;
  scan.sensor = "handheld";
  EXPECT_THROW(Fuse::at(GetParam()).run(scan, calibration, {}, 1), InputError);
  scan.depth_mm.assign(40, cv::Mat::zeros(calibration.ir.height, calibration.ir.width, CV_16U));
  EXPECT_THROW(Fuse::at(GetParam()).run(scan, calibration, {}, 1), InputError);
  scan.depth_mm.assign(40, cv::Mat::zeros(7, 9, CV_16U));
  EXPECT_THROW(Fuse::at(GetParam()).run(scan, calibration, {}, 1), InputError);
}

INSTANTIATE_TEST_SUITE_P(Variants, EveryFuse, testing::ValuesIn(Fuse::automatic_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace dressform
