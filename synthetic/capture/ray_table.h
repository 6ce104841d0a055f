#pragma once
#include <vector>

#include "scenes/camera.h"
#include "scenes/mesh.h"

namespace dressform {

// The ideal image-plane coordinates (x/z, y/z) of every pixel centre of a distorted camera, with a margin of one pixel:
// the inversion of the distortion is paid once per camera.
class RayTable {
 public:
  explicit RayTable(const Camera& camera);

  int width() const { return width_; }
  int height() const { return height_; }
  // At a pixel centre; -1 <= x <= width, -1 <= y <= height.
  const Vector2f& at(int x, int y) const { return table_[(y + 1) * (width_ + 2) + (x + 1)]; }
  // Between pixel centres: bilinear (the distortion is smooth; the error is below 1e-3 px).
  Vector2f at(float x, float y) const;

 private:
  int width_, height_;
  std::vector<Vector2f> table_;
};

}  // namespace dressform
