#include "synthetic/room/room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "synthetic/capture/ray_scene.h"
#include "synthetic/capture/shapes.h"

namespace dressform {
namespace {

Body ball_body() {
  Body body;
  body.mesh = sphere_mesh({0.1, 0.3, 0}, 0.06, 40);
  body.landmarks.ankle = 0.1;
  body.landmarks.knee = 0.5;
  return body;
}

TEST(Room, EveryRayFromInsideEndsOnASurface) {
  for (const auto& room :
       {RoomSpec{}, RoomSpec{6, 5, 2.7, false}, RoomSpec{4.6, 4.4, 2.4, true}, RoomSpec{9, 12, 4, true}}) {
    const RayScene scene(make_room(room));
    for (int i = 0; i < 50; ++i) {
      RayPacket rays;
      for (int lane = 0; lane < packet_size; ++lane) {
        const double a = 0.37 * (16 * i + lane), b = 1.1 * (16 * i + lane);
        rays.set(lane, {0.2f, 1.3f, -0.1f}, Vector3d(std::cos(a), std::sin(b), std::sin(a)).cast<float>(), 0, 100);
      }
      HitPacket hits;
      scene.intersect(rays, hits, Coherence::incoherent);
      for (const int surface : hits.surface) ASSERT_GE(surface, 0);
    }
  }
}

TEST(Room, WallsFaceInwards) {
  for (const auto& surface : make_room(RoomSpec{6, 5, 2.7, false})) {
    if (surface.name == "skirting") continue;
    const auto& t = surface.mesh.triangles.front();
    const auto& v = surface.mesh.vertices;
    const Vector3d normal = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]);
    EXPECT_GT(normal.dot(Vector3d(0, 1.3, 0) - v[t[0]]), 0) << surface.name;
  }
}

// Nothing but floor, ceiling and walls is nearer to the mannequin than the rig and the walk of the scan.
TEST(Room, FurnitureLeavesTheMiddleFree) {
  for (const auto& surface : make_room(RoomSpec{})) {
    const std::set<std::string> shell{"floor", "ceiling", "wall -z", "wall +z", "wall +x", "wall -x", "skirting"};
    if (shell.count(surface.name)) continue;
    for (const auto& v : surface.mesh.vertices)
      ASSERT_TRUE(std::hypot(v.x(), v.z()) > 2.3 || std::abs(v.z()) > 2.4) << surface.name << " " << v.transpose();
  }
}

TEST(Room, NothingIsLabelled) {
  for (const auto& surfaces : {make_room(RoomSpec{}), make_stand(ball_body()), make_bulbs({LightSpec{}})})
    for (const auto& surface : surfaces) {
      EXPECT_EQ(surface.label, Label::none);
      EXPECT_FALSE(surface.mesh.triangles.empty());
    }
}

TEST(Room, TheRodHoldsTheCalf) {
  const auto stand = make_stand(ball_body());
  ASSERT_EQ(stand.size(), 1u);
  EXPECT_TRUE(stand[0].material.chrome);
  double highest = 0, nearest = 1e9;
  for (const auto& v : stand[0].mesh.vertices) {
    highest = std::max(highest, v.y());
    if (v.y() > 0.1) nearest = std::min(nearest, std::abs((v - Vector3d(0.1, 0.3, 0)).norm() - 0.06));
    EXPECT_GE(v.y(), 0);
  }
  EXPECT_GT(highest, 0.25);
  EXPECT_LT(nearest, 0.06);
}

}  // namespace
}  // namespace dressform
