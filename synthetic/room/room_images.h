#pragma once
#include <opencv2/core/mat.hpp>

namespace dressform {

// Albedo images (8-bit BGR, sRGB) of a room's surfaces, `width_m` x `height_m`.
cv::Mat paint_floor(double width_m, double depth_m);                // laminated planks
cv::Mat paint_wall(double width_m, double height_m, int number);    // faintly uneven plaster
cv::Mat paint_poster(double width_m, double height_m, int number);  // framed colour fields

}  // namespace dressform
