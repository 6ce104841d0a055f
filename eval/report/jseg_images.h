#pragma once
#include <string>
#include <utility>
#include <vector>

#include "pipeline/segment/jseg_regions.h"

namespace dressform {

// Label maps as 16-bit grey, label for label: 0 outside the mask. Throws InputError naming `where` for more labels than
// 16 bits can tell apart.
cv::Mat label_image_16bit(const std::string& where, const cv::Mat& labels);

// The image with the borders between regions in red.
cv::Mat border_overlay(const cv::Mat& bgr, const cv::Mat& regions);

// The steps of JSEG as images to look at, with the names of their files: class map in the classes' colours, J-images of
// all scales (white: J = 1 or more), valleys, borders before and after merging.
std::vector<std::pair<std::string, cv::Mat>> jseg_images(const cv::Mat& bgr, const JsegResult& found);

}  // namespace dressform
