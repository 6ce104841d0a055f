#pragma once
#include <opencv2/core/mat.hpp>

#include "scenes/camera.h"

namespace dressform {

struct OutlineParams {
  double band_px = 6;      // at 1920 x 1080: how far the outline may move from the depth's
  double unknown_px = 24;  // at 1920 x 1080: how far from the body a place without depth may still be the body
  double smoothness = 5;   // of the cut, nats
};

// What the same camera saw without the clothes: the colours behind the outline.
struct Background {
  cv::Mat bgr;
  cv::Mat body;  // uint8 at colour size: where the body hides the background
};

// The body's mask at colour size (255, 0) from its mask on the depth grid. The outline is drawn by a minimum cut
// between local colour models of body and surroundings; where `background` shows the same place without the body, a
// pixel that did not change speaks against the body. depth_mm: true depth, float32.
cv::Mat color_outline(const cv::Mat& bgr, const cv::Mat& depth_mm, const cv::Mat& mask, const SensorCalibration& sensor,
                      const OutlineParams& params, const Background* background = nullptr);

}  // namespace dressform
