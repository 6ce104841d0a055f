#pragma once
#include <opencv2/core/mat.hpp>

#include "scenes/camera.h"
#include "scenes/frame.h"

namespace dressform {

// From the depth grid to the colour image of the same shot and back, with the occlusions between the two cameras.

// True depth: raw depth with the sensor's depth offset removed. float32, mm along the IR axis, IR grid, 0 = none.
cv::Mat corrected_depth_mm(const cv::Mat& raw_depth_mm, const SensorCalibration& sensor);

// Ideal image-plane coordinates (x/z, y/z) of every pixel of a camera. float32 x 2, camera's size.
cv::Mat pixel_rays(const Camera& camera);

// Points in the IR camera frame, metres, from true depth. float32 x 3, IR grid; NaN where there is no depth.
cv::Mat depth_points_m(const cv::Mat& depth_mm, const Camera& ir);

// Per colour pixel, what the depth image says it sees. Where neighbouring depth pixels differ by more than the jump
// they are not joined, so that colour pixels that only the colour camera sees stay empty.
struct ColorDepthMap {
  cv::Mat depth_pixel;  // float32 x 2, colour size: raw pixel (x, y) of the IR grid, between pixels; NaN = none
  cv::Mat depth_mm;     // float32, colour size: z in the IR camera frame; 0 = none
  cv::Mat z_mm;         // float32, colour size: z in the colour camera frame; 0 = none
};

// depth_mm: true depth (corrected_depth_mm). max_jump_mm: largest depth difference of pixels that are joined.
ColorDepthMap color_depth_map(const cv::Mat& depth_mm, const SensorCalibration& sensor, double max_jump_mm = 30);

// Raw colour pixel (x, y) of every depth pixel, float32 x 2, IR grid; NaN where there is no depth, where the pixel
// falls outside the colour image, or, when `map` is given, where something more than `ghost_mm` nearer hides the point
// from the colour camera (else the arm's colour lands on the torso).
cv::Mat color_of_depth_pixels(const cv::Mat& depth_mm, const SensorCalibration& sensor,
                              const ColorDepthMap* map = nullptr, double ghost_mm = 15);

// An image on the IR grid seen from the colour camera: nearest value, `none` where the map is empty.
// Any one-channel type; the result has the type of `image`.
cv::Mat to_color(const cv::Mat& image, const ColorDepthMap& map, double none = 0);

// An image at colour size read at the depth pixels (color_of_depth_pixels): nearest value, `none` where NaN.
cv::Mat to_depth(const cv::Mat& image, const cv::Mat& color_pixels, double none = 0);

}  // namespace dressform
