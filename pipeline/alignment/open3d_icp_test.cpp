#include "pipeline/alignment/open3d_icp.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstdint>
#include <functional>

#include "pipeline/geometry/lattice.h"
#include "pipeline/testing/figure.h"
#include "scenes/random.h"

namespace dressform {
namespace {

Isometry3d moved(const Vector3d& axis, double degrees, const Vector3d& by) {
  Isometry3d motion(Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()));
  motion.translation() = by;
  return motion;
}

PointCloud transformed_cloud(const PointCloud& cloud, const Isometry3d& motion) {
  PointCloud result = cloud;
  for (Vector3d& p : result.points) p = motion * p;
  for (Vector3d& n : result.normals) n = motion.linear() * n;
  return result;
}

double degrees_between(const Isometry3d& a, const Isometry3d& b) {
  return 180 / M_PI * Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

// The inside of a corner, 0.4 m along each edge, points at random with a millimetre of noise.
PointCloud corner(std::uint64_t seed, int points = 2000) {
  PointCloud cloud;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < points; ++i) {
      const auto u = uniform4(seed, axis, i);
      Vector3d p(0.4 * u[0], 0.4 * u[1], 0.4 * u[2]);
      p[axis] = 0.001 * normal(seed, 3 + axis, i);
      cloud.points.push_back(p);
      cloud.normals.push_back(Vector3d::Unit(axis));
    }
  return cloud;
}

TEST(Open3dIcp, BothFindTheMotionBetweenTwoSamplesOfACorner) {
  const Isometry3d truth = moved({1, 2, 3}, 2, {0.006, -0.004, 0.005});
  const PointCloud target = corner(1), source = transformed_cloud(corner(2), truth.inverse());
  for (const auto& icp : {generalized_icp, plane_icp}) {
    const Isometry3d found = icp(source, target, Isometry3d::Identity(), {0.03, 50});
    EXPECT_LT(degrees_between(found, truth), 0.05);
    EXPECT_LT((found.translation() - truth.translation()).norm(), 0.0005);
  }
}

// A printed board: distances say nothing of where along it a view lies, colours do.
PointCloud board(std::uint64_t seed, bool printed) {
  PointCloud cloud;
  for (int i = 0; i < 6000; ++i) {
    const auto u = uniform4(seed, 9, i);
    const Vector3d p(0.5 * u[0], 0.5 * u[1], 0);
    const double grey = 0.5 + 0.2 * std::sin(2 * M_PI * p.x() / 0.15) + 0.2 * std::sin(2 * M_PI * p.y() / 0.11);
    cloud.points.push_back(p);
    cloud.normals.push_back(Vector3d::UnitZ());
    cloud.colors.push_back(Vector3f::Constant(printed ? static_cast<float>(grey) : 0.5f));
  }
  return cloud;
}

TEST(Open3dIcp, ColoursHoldWhatAPlaneLetsSlide) {
  const Isometry3d truth = moved({0, 0, 1}, -1, {0.008, -0.006, 0.004});
  const auto found = [&](bool printed) {
    return color_icp(transformed_cloud(board(2, printed), truth.inverse()), board(1, printed), Isometry3d::Identity(),
                     {0.02, 50}, 0.968);
  };
  const Vector3d middle(0.25, 0.25, 0), start = truth.inverse() * middle;
  EXPECT_LT((found(true) * start - middle).norm(), 0.0015);
  EXPECT_GT((found(false) * start - middle).norm(), 0.006) << "slides where nothing is printed";
  EXPECT_NEAR((found(false) * start).z(), 0, 0.0005);
}

// Three arms of different lengths and widths at right angles: no two sides of it look alike.
PointCloud caltrop() {
  const Lattice lattice = make_lattice({-0.2, -0.2, -0.2}, {0.6, 0.5, 0.4}, 0.02, 0.02);
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Vector3d p = lattice.point(i);
    const double d =
        std::min({capsule_distance(p, {0, 0, 0}, {0.5, 0, 0}, 0.05), capsule_distance(p, {0, 0, 0}, {0, 0.35, 0}, 0.09),
                  capsule_distance(p, {0, 0, 0}, {0, 0.05, 0.25}, 0.07)});
    field[i] = static_cast<float>(d);
  }
  const Mesh mesh = lattice_surface(lattice, field);
  return {mesh.vertices, vertex_normals(mesh), {}, {}};
}

TEST(Open3dIcp, FastGlobalFindsAnyTurnWithoutAStart) {
  const PointCloud target = caltrop();
  for (const double degrees : {100.0, 180.0}) {
    const Isometry3d truth = moved({1, 1, 0.3}, degrees, {0.4, -1, 2});
    const auto found = fast_global(transformed_cloud(target, truth.inverse()), target, 0.025, 7);
    ASSERT_TRUE(found);
    EXPECT_LT(degrees_between(*found, truth), 5);
    EXPECT_LT(((*found * truth.inverse()) * Vector3d(0.1, 0.1, 0.1) - Vector3d(0.1, 0.1, 0.1)).norm(), 0.03);
  }
  PointCloud few = target;
  few.points.resize(20), few.normals.resize(20);
  EXPECT_FALSE(fast_global(few, target, 0.025, 7));
}

// Open3D adds up in the order in which threads end; here it has one.
TEST(Open3dIcp, SameBytesWhateverTheThreads) {
  const PointCloud target = caltrop(), plate = board(1, true);
  const Isometry3d truth = moved({1, 0, 0}, 3, {0.01, 0, 0.005});
  const PointCloud source = transformed_cloud(target, truth.inverse());
  const PointCloud other_plate = transformed_cloud(board(2, true), truth.inverse());
  const Isometry3d start = Isometry3d::Identity();
  const std::function<Isometry3d()> calls[] = {
      [&] {
        return generalized_icp(source, target, start, {0.04, 20});
      },
      [&] {
        return plane_icp(source, target, start, {0.04, 20});
      },
      [&] {
        return color_icp(other_plate, plate, start, {0.04, 20}, 0.968);
      },
      [&] { return *fast_global(source, target, 0.03, 1); },
  };
  const int before = omp_get_max_threads();
  for (const auto& call : calls) {
    omp_set_num_threads(1);
    const Isometry3d one = call();
    omp_set_num_threads(2);
    EXPECT_EQ(call().matrix(), one.matrix());
    EXPECT_EQ(omp_get_max_threads(), 2) << "left as it was";
  }
  omp_set_num_threads(before);
}

TEST(ColoredBy, TakesTheMeanNearbyAndElseTheNearestColour) {
  PointCloud line;
  for (const double x : {0.0, 0.01, 0.5}) line.points.emplace_back(x, 0, 0), line.normals.emplace_back(0, 0, 1);
  PointCloud seen;
  seen.points = {{0, 0.001, 0}, {0, -0.001, 0}, {0.01, 0, 0}};
  seen.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, -1}};
  seen.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PointCloud colored = colored_by(line, seen, 0.005);
  const Vector3f mean(0.5f, 0.5f, 0);
  EXPECT_EQ(colored.colors[0], mean);
  EXPECT_EQ(colored.colors[1], mean) << "seen from the other side";
  EXPECT_EQ(colored.colors[2], mean) << "nobody saw it";
  EXPECT_EQ(colored_by(line, {}, 0.005).colors[0], Vector3f::Constant(0.5f));
}

}  // namespace
}  // namespace dressform
