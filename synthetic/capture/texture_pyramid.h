#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "scenes/mesh.h"
#include "scenes/srgb.h"

namespace dressform {

// An image with its halved copies, averaged in linear light: reading it at the size of a footprint does not alias.
class TexturePyramid {
 public:
  // texture: 8-bit BGR, sRGB; throws InputError for anything else.
  explicit TexturePyramid(const cv::Mat& texture);

  // Linear RGB at (u, v), v down, clamped to the border; footprint: width in texels of the finest level that one
  // sample stands for. Bilinear in the two nearest levels, blended.
  Vector3f sample(const Vector2f& uv, float footprint_texels) const;

  int width() const { return levels_.front().cols; }
  int height() const { return levels_.front().rows; }

 private:
  Vector3f bilinear(int level, const Vector2f& uv) const;
  std::vector<cv::Mat> levels_;
};

}  // namespace dressform
