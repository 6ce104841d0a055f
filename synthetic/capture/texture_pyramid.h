#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "scenes/mesh.h"

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

// sRGB transfer of one value in 0-1.
float linear_from_srgb(float value);
float srgb_from_linear(float value);

}  // namespace dressform
