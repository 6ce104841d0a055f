#pragma once
#include <vector>

#include "render/geometry.h"
#include "render/gl_context.h"
#include "render/shaders.h"

namespace dressform {

// The items of an image in OpenGL's memory, for any number of views.
class UploadedItems {
 public:
  UploadedItems(GlContext& context, const std::vector<RenderItem>& items);
  ~UploadedItems();
  UploadedItems(const UploadedItems&) = delete;
  UploadedItems& operator=(const UploadedItems&) = delete;

  // Draws into the bound target. Opaque items first, then the others in their order, each with only its nearest
  // surface. coverage: white, opaque and unlit, whatever the shading.
  void draw(Programs& programs, const RenderView& view, bool coverage) const;

 private:
  struct Uploaded {
    Shading shading;
    Eigen::Vector3f color;
    float opacity;
    bool two_sided, points;
    unsigned vertex_array = 0, vertices = 0, indices = 0, image = 0;
    int count = 0;
  };

  void upload(const RenderItem& item);
  unsigned upload_image(const cv::Mat& image, bool filtered);
  void draw_item(const Uploaded& item) const;
  void draw_nearest_surface(const Uploaded& item) const;

  GlContext& context_;
  Vector3d origin_ = Vector3d::Zero();
  Eigen::AlignedBox3d box_;
  std::vector<Uploaded> items_;
};

// Clip space of a pinhole camera with pixel centres at integers: x, y to [-1, 1] over the image, upside down for
// OpenGL so that the first row read back is the top one.
Eigen::Matrix4d clip_from_camera(const Camera& camera, double near_m, double far_m);

}  // namespace dressform
