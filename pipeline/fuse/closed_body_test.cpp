#include "pipeline/fuse/closed_body.h"

#include <gtest/gtest.h>

#include "pipeline/fuse/body_points.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/testing/figure.h"
#include "pipeline/testing/test_scene.h"

namespace dressform {
namespace {

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

}  // namespace
}  // namespace dressform
