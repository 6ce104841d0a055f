#include "pipeline/surface/overhang.h"

#include <gtest/gtest.h>

#include "pipeline/testing/dressed_figure.h"

namespace dressform {
namespace {

Vector3d centre_of(const Mesh& mesh, std::size_t triangle) {
  const Vector3i& t = mesh.triangles[triangle];
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
}

TEST(Overhang, AChinHangsAndWhatBearsItDoesNot) {
  const double chin_m = 0.14;
  const Mesh body = figure::body_mesh(0.015, chin_m);
  const std::vector<char> hangs = overhanging(body, find_landmarks(body));
  int of_chin = 0;
  for (std::size_t i = 0; i < body.triangles.size(); ++i) {
    const Vector3d p = centre_of(body, i);
    if (figure::chin(p, chin_m) < 0.004 && p.y() < 1.52 && p.z() > 0.1) {
      EXPECT_TRUE(hangs[i]) << p.transpose();
      ++of_chin;
    }
    if (p.y() < 1.55 && figure::chin(p, chin_m) > 0.02) {
      EXPECT_FALSE(hangs[i]) << p.transpose();
    }
  }
  EXPECT_GT(of_chin, 20);
}

// A slab with a hollow in its upper side: one climbs down into it, but nothing is beneath.
TEST(Overhang, AHollowDoesNotHang) {
  const Mesh slab = figure::surface_of({-0.2, -0.1, -0.2}, {0.2, 0.1, 0.2}, 0.01, [](const Vector3d& p) {
    const double block = (p.cwiseAbs() - Vector3d(0.2, 0.1, 0.2)).maxCoeff();
    return std::max(block, 0.06 - (p - Vector3d(0, 0.12, 0)).norm());
  });
  Landmarks landmarks;
  landmarks.triangle_parts.assign(slab.triangles.size(), BodyPart::torso);
  landmarks.armpit_y = -0.05;
  for (const char hangs : overhanging(slab, landmarks)) EXPECT_FALSE(hangs);
}

TEST(Overhang, NothingHangsBelowTheHead) {
  const Mesh body = figure::body_mesh(0.015);
  const std::vector<char> hangs = overhanging(body, find_landmarks(body));
  for (std::size_t i = 0; i < body.triangles.size(); ++i)
    if (centre_of(body, i).y() < 1.58) {
      EXPECT_FALSE(hangs[i]) << centre_of(body, i).transpose();
    }
}

}  // namespace
}  // namespace dressform
