#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/geometry/lattice.h"
#include "scenes/error.h"
#include "scenes/serialize.h"

namespace dressform {
namespace {

double capsule(const Vector3d& p, const Vector3d& a, const Vector3d& b, double radius) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - radius;
}

// A figure of capsules that faces `yaw` from +z: torso, head, legs with feet, arms 15 degrees out.
Mesh figure(double yaw) {
  const Lattice lattice = make_lattice({-0.6, 0, -0.6}, {0.6, 1.8, 0.6}, 0.03, 0.012);
  const Eigen::AngleAxisd turn(-yaw, Vector3d::UnitY());
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i) {
    Vector3d p = turn * lattice.point(i);
    double d = capsule(p, {0, 1.0, 0}, {0, 1.35, 0}, 0.15);
    d = std::min(d, capsule(p, {0, 1.4, 0}, {0, 1.7, 0}, 0.06));
    d = std::min(d, (p - Vector3d(0, 1.68, 0)).norm() - 0.10);
    for (const double side : {-1.0, 1.0}) {
      d = std::min(d, capsule(p, {side * 0.09, 0.06, 0}, {side * 0.09, 0.95, 0}, 0.07));
      d = std::min(d, capsule(p, {side * 0.09, 0.04, 0}, {side * 0.09, 0.04, 0.14}, 0.04));
      d = std::min(d, capsule(p, {side * 0.16, 1.40, 0}, {side * 0.34, 0.75, 0}, 0.045));
    }
    field[i] = static_cast<float>(d);
  }
  return lattice_surface(lattice, field);
}

TEST(BodyLimbs, SectionOfACylinderHasItsArea) {
  const Lattice lattice = make_lattice({-0.1, 0, -0.1}, {0.1, 0.3, 0.1}, 0.02, 0.008);
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i)
    field[i] = static_cast<float>(capsule(lattice.point(i), {0.01, 0.05, 0}, {0.01, 0.25, 0}, 0.06));
  const Sections sections = horizontal_sections(lattice_surface(lattice, field));
  const auto& level = sections.levels[sections.level(0.15)];
  ASSERT_EQ(level.size(), 1u);
  EXPECT_NEAR(level[0].area_m2, M_PI * 0.06 * 0.06, 1e-4);
  EXPECT_NEAR(level[0].centroid.x(), 0.01, 1e-4);
  EXPECT_TRUE(contains(level[0], {0.01, 0, 0.05}));
  EXPECT_FALSE(contains(level[0], {0.01, 0, 0.07}));
}

class BodyLimbsAtYaw : public ::testing::TestWithParam<double> {};

TEST_P(BodyLimbsAtYaw, FindsEveryLimbWhateverTheHeading) {
  const double yaw = GetParam();
  const Landmarks limbs = find_landmarks(figure(yaw));
  const Vector3d front(std::sin(yaw), 0, std::cos(yaw)), left(std::cos(yaw), 0, -std::sin(yaw));
  EXPECT_GT(limbs.front.dot(front), 0.99);
  EXPECT_GT(limbs.left.dot(left), 0.99);
  ASSERT_TRUE(limbs.left_leg && limbs.right_leg && limbs.left_arm && limbs.right_arm);
  EXPECT_GT(limbs.left_arm->root.dot(left), 0.1);
  EXPECT_LT(limbs.right_arm->root.dot(left), -0.1);
  EXPECT_GT(limbs.left_leg->root.dot(left), 0.05);
  EXPECT_NEAR(limbs.crotch_y, 0.87, 0.06);
  EXPECT_NEAR(limbs.armpit_y, 1.24, 0.06);
  EXPECT_NEAR(limbs.neck_y, 1.53, 0.06);
  const Vector3d arm = (left * 0.18 - Vector3d(0, 0.65, 0)).normalized();
  EXPECT_GT(limbs.left_arm->direction.dot(arm), 0.99);
}
INSTANTIATE_TEST_SUITE_P(Headings, BodyLimbsAtYaw, ::testing::Values(0.0, 0.7, 2.0, -2.5));

TEST(BodyLimbs, LabelsTheTriangles) {
  const Mesh mesh = figure(0);
  const Landmarks limbs = find_landmarks(mesh);
  ASSERT_EQ(limbs.triangle_parts.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3d& p = mesh.vertices[mesh.triangles[i][0]];
    const BodyPart part = limbs.triangle_parts[i];
    if (p.y() < 0.8 && std::abs(p.x()) < 0.17) {
      EXPECT_EQ(part, p.x() > 0 ? BodyPart::left_leg : BodyPart::right_leg);
    }
    if (p.y() < 1.1 && p.y() > 0.72 && std::abs(p.x()) > 0.20) {
      EXPECT_EQ(part, p.x() > 0 ? BodyPart::left_arm : BodyPart::right_arm) << p.transpose();
    }
    if (p.y() > 1.0 && p.y() < 1.2 && std::abs(p.x()) < 0.15) {
      EXPECT_EQ(part, BodyPart::torso);
    }
    if (p.y() > 1.6) {
      EXPECT_EQ(part, BodyPart::head);
    }
  }
}

TEST(BodyLimbs, ABallHasNoLimbs) {
  const Lattice lattice = make_lattice({-0.3, 0, -0.3}, {0.3, 0.6, 0.3}, 0.03, 0.02);
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i)
    field[i] = static_cast<float>((lattice.point(i) - Vector3d(0, 0.3, 0)).norm() - 0.3);
  const Landmarks limbs = find_landmarks(lattice_surface(lattice, field));
  EXPECT_FALSE(limbs.left_arm || limbs.right_arm || limbs.left_leg || limbs.right_leg);
}

TEST(BodyLimbs, AnEmptyMeshIsAnError) {
  EXPECT_THROW(find_limbs(Mesh{}), InputError);
  EXPECT_THROW(find_landmarks(Mesh{}), InputError);
  EXPECT_THROW(require_known({}, "here"), InputError);
  KnownBody other = known_body(figure(0));
  other.landmarks.triangle_parts.pop_back();
  EXPECT_THROW(require_known(other, "here"), InputError);
}

TEST(BodyLimbs, TransformedLandmarksAreThoseOfTheTransformedMesh) {
  const Mesh mesh = figure(0.4);
  Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();
  motion.topLeftCorner<3, 3>() = Eigen::AngleAxisd(1.1, Vector3d::UnitY()).toRotationMatrix();
  motion.topRightCorner<3, 1>() = Vector3d(0.3, 0.25, -0.2);
  const Landmarks moved = transformed(find_landmarks(mesh), motion), found = find_landmarks(transformed(mesh, motion));
  EXPECT_LT((moved.front - found.front).norm(), 1e-6);
  EXPECT_LT((moved.axis - found.axis).norm(), 1e-6);
  EXPECT_NEAR(moved.waist_y, found.waist_y, 1e-6);
  EXPECT_NEAR(moved.neck_y, found.neck_y, 1e-6);
  EXPECT_LT((moved.left_arm->root - found.left_arm->root).norm(), 1e-6);
  EXPECT_EQ(moved.triangle_parts, found.triangle_parts);
}

TEST(BodyLimbs, LandmarksSurviveTheArchive) {
  const Landmarks found = find_landmarks(figure(0.4));
  std::string bytes = to_bytes(found);
  const Landmarks read = from_bytes<Landmarks>(bytes);
  EXPECT_EQ(to_bytes(read), bytes);
  EXPECT_EQ(read.triangle_parts, found.triangle_parts);
  EXPECT_EQ(read.front_from, FrontFrom::feet);
  bytes.back() = 77;  // the last triangle's part
  EXPECT_THROW(from_bytes<Landmarks>(bytes), std::runtime_error);
}

}  // namespace
}  // namespace dressform
