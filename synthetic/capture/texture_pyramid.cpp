#include "synthetic/capture/texture_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "scenes/error.h"
#include "scenes/srgb.h"

namespace dressform {
namespace {

std::array<float, 256> make_linear_table() {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) table[i] = linear_from_srgb(i / 255.0f);
  return table;
}

const std::array<float, 256>& linear_table() {
  static const std::array<float, 256> table = make_linear_table();
  return table;
}

cv::Mat to_linear(const cv::Mat& bgr) {
  cv::Mat linear(bgr.size(), CV_32FC3);
  const auto& table = linear_table();
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x) {
      const auto& in = bgr.at<cv::Vec3b>(y, x);
      linear.at<cv::Vec3f>(y, x) = {table[in[0]], table[in[1]], table[in[2]]};
    }
  return linear;
}

cv::Mat to_srgb(const cv::Mat& linear) {
  cv::Mat bgr(linear.size(), CV_8UC3);
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      for (int c = 0; c < 3; ++c)
        bgr.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<std::uint8_t>(255.0f * srgb_from_linear(linear.at<cv::Vec3f>(y, x)[c]));
  return bgr;
}

}  // namespace

TexturePyramid::TexturePyramid(const cv::Mat& texture) {
  if (texture.empty() || texture.type() != CV_8UC3)
    throw InputError("texture", "found an image that is not 8-bit BGR; expected 8-bit BGR");
  levels_.push_back(texture.clone());
  cv::Mat linear = to_linear(texture);
  while (linear.cols > 1 || linear.rows > 1) {
    cv::Mat half;
    cv::resize(linear, half, {std::max(1, linear.cols / 2), std::max(1, linear.rows / 2)}, 0, 0, cv::INTER_AREA);
    linear = half;
    levels_.push_back(to_srgb(linear));
  }
}

Vector3f TexturePyramid::bilinear(int level, const Vector2f& uv) const {
  const cv::Mat& image = levels_[level];
  const float x = std::clamp(uv.x() * image.cols - 0.5f, 0.0f, image.cols - 1.0f);
  const float y = std::clamp(uv.y() * image.rows - 0.5f, 0.0f, image.rows - 1.0f);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.cols - 1), y1 = std::min(y0 + 1, image.rows - 1);
  const float ax = x - x0, ay = y - y0;
  const auto& table = linear_table();
  const auto texel = [&](int xi, int yi) {
    const auto& bgr = image.at<cv::Vec3b>(yi, xi);
    return Vector3f(table[bgr[2]], table[bgr[1]], table[bgr[0]]);
  };
  const Vector3f above = (1 - ax) * texel(x0, y0) + ax * texel(x1, y0);
  const Vector3f below = (1 - ax) * texel(x0, y1) + ax * texel(x1, y1);
  return (1 - ay) * above + ay * below;
}

Vector3f TexturePyramid::sample(const Vector2f& uv, float footprint_texels) const {
  if (!uv.allFinite()) return Vector3f::Zero();
  const float level = std::log2(std::max(1.0f, footprint_texels));
  const int last = static_cast<int>(levels_.size()) - 1;
  const int fine = std::min(static_cast<int>(level), last), coarse = std::min(fine + 1, last);
  const float blend = std::min(level - fine, 1.0f);
  const Vector3f first = bilinear(fine, uv);
  if (blend <= 0.01f || fine == coarse) return first;
  return (1 - blend) * first + blend * bilinear(coarse, uv);
}

}  // namespace dressform
