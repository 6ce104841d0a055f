#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/camera.h"
#include "scenes/mesh.h"

namespace dressform {

enum class Shading { textured, unlit, shaded, normals, wireframe, points, scalar };

// One thing in an image. Exactly one of `mesh` (any Shading but points) and `points` is set.
struct RenderItem {
  const Mesh* mesh = nullptr;
  const TexturedMesh* textured = nullptr;  // instead of mesh: textured, unlit
  const PointCloud* points = nullptr;
  Shading shading = Shading::shaded;
  Eigen::Vector3f color = Eigen::Vector3f(0.75f, 0.75f, 0.78f);  // RGB sRGB, for shaded, wireframe, uncoloured points
  std::vector<double> scalars;  // per vertex (mesh) or point, for Shading::scalar; NaN is drawn grey
  double scalar_minimum = 0, scalar_maximum = 1;
  bool two_sided = true;  // garments: the inside is drawn, darker
  float opacity = 1;
};

// A pinhole view (no distortion) of the world, OpenCV convention.
struct RenderView {
  Camera camera;
  Isometry3d camera_from_world = Isometry3d::Identity();
};

struct RenderOptions {
  int samples = 4;  // supersampling per axis squared or MSAA: 1 or 4
  Eigen::Vector3f background = Eigen::Vector3f(1, 1, 1);
  bool transparent_background = false;
};

// Off-screen OpenGL 4.5 core through OSMesa; one context for the life of the object. Not thread safe; images are the
// same whatever the number of threads. Throws std::runtime_error when no context can be made.
class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // 8-bit BGR image of camera.width x camera.height (BGRA with a transparent background).
  cv::Mat render(const RenderView& view, const std::vector<RenderItem>& items, const RenderOptions& options = {});

  // The same for several views; the items are prepared once.
  std::vector<cv::Mat> render(const std::vector<RenderView>& views, const std::vector<RenderItem>& items,
                              const RenderOptions& options = {});

  // Coverage of the items: uint8, 255 where something is drawn, no anti-aliasing.
  cv::Mat mask(const RenderView& view, const std::vector<RenderItem>& items);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

// A view that frames the box [minimum, maximum] from the direction azimuth/elevation (0, 0: from +z; 90: from +x).
RenderView look_at_box(const Vector3d& minimum, const Vector3d& maximum, double azimuth_deg, double elevation_deg,
                       int width, int height, double fov_deg = 30);

// Front, left, back and right side by side; and a turntable contact sheet of `count` views.
cv::Mat four_views(Renderer& renderer, const std::vector<RenderItem>& items, int height, const RenderOptions& = {});
cv::Mat contact_sheet(Renderer& renderer, const std::vector<RenderItem>& items, int count, int columns, int tile_height,
                      const RenderOptions& = {});

// Appends a colour bar with ticks and unit to the right of an image of Shading::scalar.
cv::Mat with_color_bar(const cv::Mat& image, double minimum, double maximum, const std::string& unit,
                       const std::string& title);

}  // namespace dressform
