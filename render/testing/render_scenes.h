#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "render/renderer.h"

// Scenes whose pictures are known, and a renderer that the tests of a suite share.
namespace dressform::render_scenes {

// Camera of 100 x 80 pixels at the origin, looking along +z, y down: one metre at z = 1 is 40 pixels.
inline RenderView simple_view() {
  RenderView view;
  view.camera.width = 100;
  view.camera.height = 80;
  view.camera.fx = view.camera.fy = 40;
  view.camera.cx = 49.5;
  view.camera.cy = 39.5;
  return view;
}

// Square [-half, half]^2 at depth z that faces the camera of simple_view (counter-clockwise for it), corners in the
// order top left, bottom left, bottom right, top right.
inline Mesh square(double half, double z) {
  return {{{-half, -half, z}, {-half, half, z}, {half, half, z}, {half, -half, z}}, {{0, 1, 2}, {0, 2, 3}}};
}

inline TexturedMesh textured_square(const cv::Mat& texture) {
  TexturedMesh result{square(1, 2), {}, texture};
  const Vector2f uv[] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  for (const Vector3i& t : result.mesh.triangles) result.corner_uv.push_back({uv[t[0]], uv[t[1]], uv[t[2]]});
  return result;
}

inline Mesh sphere(double radius, const Vector3d& center, int rings) {
  Mesh mesh;
  const int sectors = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double polar = M_PI * i / rings, turn = 2 * M_PI * j / sectors;
      mesh.vertices.push_back(center + radius * Vector3d(std::sin(polar) * std::sin(turn), std::cos(polar),
                                                         std::sin(polar) * std::cos(turn)));
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const int a = i * sectors + j, b = i * sectors + (j + 1) % sectors, c = a + sectors, d = b + sectors;
      mesh.triangles.push_back({a, c, d});
      mesh.triangles.push_back({a, d, b});
    }
  return mesh;
}

inline RenderItem item_of(const Mesh& mesh, Shading shading = Shading::shaded) {
  RenderItem item;
  item.mesh = &mesh;
  item.shading = shading;
  return item;
}

inline RenderItem item_of(const TexturedMesh& mesh, Shading shading = Shading::unlit) {
  RenderItem item;
  item.textured = &mesh;
  item.shading = shading;
  return item;
}

inline RenderItem item_of(const PointCloud& points) {
  RenderItem item;
  item.points = &points;
  item.shading = Shading::points;
  return item;
}

inline cv::Vec3b pixel(const cv::Mat& image, int x, int y) { return image.at<cv::Vec3b>(y, x); }

inline bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

class RendererTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { renderer_ = new Renderer; }
  static void TearDownTestSuite() {
    delete renderer_;
    renderer_ = nullptr;
  }
  static Renderer& renderer() { return *renderer_; }

 private:
  inline static Renderer* renderer_ = nullptr;
};

}  // namespace dressform::render_scenes
