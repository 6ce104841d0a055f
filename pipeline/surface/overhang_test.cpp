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
  const double chin_m = 0.10;
  const Mesh body = figure::body_mesh(0.015, chin_m);
  const std::vector<char> hangs = overhanging(body, find_landmarks(body));
  int of_chin = 0;
  for (std::size_t i = 0; i < body.triangles.size(); ++i) {
    const Vector3d p = centre_of(body, i);
    if (figure::chin(p, chin_m) < 0.004 && p.y() < 1.52 && p.z() > 0.1) {
      EXPECT_TRUE(hangs[i]) << p.transpose();
      ++of_chin;
    }
    if (p.y() < 1.55 && figure::chin(p, chin_m) > 0.02) EXPECT_FALSE(hangs[i]) << p.transpose();
  }
  EXPECT_GT(of_chin, 20);
}

TEST(Overhang, NothingHangsBelowTheHead) {
  const Mesh body = figure::body_mesh(0.015);
  const std::vector<char> hangs = overhanging(body, find_landmarks(body));
  for (std::size_t i = 0; i < body.triangles.size(); ++i)
    if (centre_of(body, i).y() < 1.58) EXPECT_FALSE(hangs[i]) << centre_of(body, i).transpose();
}

}  // namespace
}  // namespace dressform
