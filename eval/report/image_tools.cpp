#include "eval/report/image_tools.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "render/charts/cairo_canvas.h"

namespace dressform {

cv::Mat side_by_side(const std::vector<cv::Mat>& images, int height, int gap) {
  std::vector<cv::Mat> parts;
  for (const auto& image : images) {
    if (image.empty()) continue;
    if (!parts.empty() && gap > 0) parts.emplace_back(height, gap, CV_8UC3, cv::Scalar::all(255));
    cv::Mat part;
    const int width = std::max(1, image.cols * height / image.rows);
    cv::resize(image, part, {width, height}, 0, 0, height < image.rows ? cv::INTER_AREA : cv::INTER_LINEAR);
    parts.push_back(part);
  }
  cv::Mat row;
  if (!parts.empty()) cv::hconcat(parts, row);
  return row;
}

cv::Mat stacked(const std::vector<cv::Mat>& images, int gap) {
  int width = 0;
  for (const auto& image : images) width = std::max(width, image.cols);
  std::vector<cv::Mat> parts;
  for (const auto& image : images) {
    if (image.empty()) continue;
    if (!parts.empty() && gap > 0) parts.emplace_back(gap, width, CV_8UC3, cv::Scalar::all(255));
    cv::Mat part;
    cv::copyMakeBorder(image, part, 0, 0, 0, width - image.cols, cv::BORDER_CONSTANT, cv::Scalar::all(255));
    parts.push_back(part);
  }
  cv::Mat column;
  if (!parts.empty()) cv::vconcat(parts, column);
  return column;
}

cv::Rect box_around(const cv::Mat& mask, double margin) {
  const cv::Rect all(0, 0, mask.cols, mask.rows);
  const cv::Rect box = cv::boundingRect(mask);
  if (box.empty()) return all;
  const int dx = static_cast<int>(box.width * margin), dy = static_cast<int>(box.height * margin);
  return cv::Rect(box.x - dx, box.y - dy, box.width + 2 * dx, box.height + 2 * dy) & all;
}

cv::Mat tinted(const cv::Mat& image, const cv::Mat& mask, const cv::Scalar& bgr, double strength) {
  cv::Mat flat(image.size(), image.type(), bgr), mixed, result = image.clone();
  cv::addWeighted(image, 1 - strength, flat, strength, 0, mixed);
  mixed.copyTo(result, mask);
  return result;
}

cv::Mat depth_image(const cv::Mat& depth_mm, double nearest_m, double farthest_m) {
  cv::Mat scaled, colors;
  const double factor = -255.0 / (1000 * (farthest_m - nearest_m));
  depth_mm.convertTo(scaled, CV_8U, factor, 255 - factor * 1000 * nearest_m);
  cv::applyColorMap(scaled, colors, cv::COLORMAP_TURBO);
  colors.setTo(cv::Scalar::all(0), depth_mm == 0);
  return colors;
}

cv::Mat infrared_image(const cv::Mat& ir) {
  std::vector<unsigned short> values(ir.begin<unsigned short>(), ir.end<unsigned short>());
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
  std::nth_element(values.begin(), at, values.end());
  cv::Mat grey, bgr;
  ir.convertTo(grey, CV_8U, 255.0 / std::max<double>(1, *at));
  cv::cvtColor(grey, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

cv::Mat titled(const cv::Mat& image, const std::string& text) {
  cv::Mat result;
  cv::Mat strip(22, image.cols, CV_8UC3, cv::Scalar::all(255));
  write_text(strip, {4, 16}, text, 14);
  cv::vconcat(strip, image, result);
  return result;
}

}  // namespace dressform
