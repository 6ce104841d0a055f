#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "render/charts/cairo_canvas.h"
#include "render/color_map.h"
#include "render/renderer.h"
#include "render/ticks.h"

namespace dressform {
namespace {

struct BarLettering {
  double size_px;
  double width(const std::string& text) const { return text_width_mm(text, size_px); }  // whatever the unit
  double height() const { return 0.73 * size_px; }                                      // of capitals and figures
  void write(cv::Mat& image, const std::string& text, double left, double middle) const {
    write_text(image, {left, middle + 0.5 * height()}, text, size_px);
  }
};

void draw_bar(cv::Mat& panel, const cv::Rect& bar) {
  cv::Mat colors, flipped;
  cv::flip(scalar_colors(), flipped, 0);
  cv::resize(flipped, colors, bar.size(), 0, 0, cv::INTER_LINEAR);
  colors.copyTo(panel(bar));
  cv::rectangle(panel, bar, cv::Scalar(60, 60, 60), 1);
}

void draw_ticks(cv::Mat& panel, const cv::Rect& bar, double minimum, double maximum, const BarLettering& letters) {
  const int most = std::clamp(static_cast<int>(bar.height / (3 * letters.height() + 1)), 1, 8);
  const double step = round_step(maximum - minimum, most);
  for (double k = std::ceil(minimum / step - 1e-9); k * step <= maximum + 1e-9 * step; ++k) {
    const double part = (k * step - minimum) / (maximum - minimum);
    const int y = bar.y + static_cast<int>(std::lround((1 - part) * (bar.height - 1)));
    cv::line(panel, {bar.x + bar.width, y}, {bar.x + bar.width + bar.width / 3, y}, cv::Scalar(60, 60, 60), 1);
    letters.write(panel, tick_text(k * step, step), bar.x + 1.5 * bar.width, y);
  }
}

}  // namespace

cv::Mat with_color_bar(const cv::Mat& image, double minimum, double maximum, const std::string& unit,
                       const std::string& title) {
  if (image.type() != CV_8UC3 || image.empty() || !(maximum > minimum) || !std::isfinite(maximum - minimum))
    throw std::invalid_argument("with_color_bar: an 8-bit BGR image and minimum < maximum are needed");
  const double scale = std::clamp(image.rows / 900.0, 0.35, 1.2);
  const BarLettering letters{std::max(7.0, 26 * scale)};
  const int line = static_cast<int>(std::lround(letters.height())),
            bar_width = std::max(8, static_cast<int>(28 * scale));
  const std::string heading = unit.empty() ? title : title.empty() ? unit : title + " [" + unit + "]";
  const double ticks_width = letters.width("-00000.0") + 2 * bar_width;
  const int width = static_cast<int>(std::ceil(std::max(letters.width(heading), ticks_width))) + 2 * line;
  cv::Mat panel(image.rows, width, CV_8UC3, cv::Scalar::all(255));
  letters.write(panel, heading, line, 2 * line);
  const int top = std::min(4 * line, image.rows / 3), bottom = std::min(2 * line, image.rows / 4);
  const cv::Rect bar(line, top, bar_width, std::max(2, image.rows - top - bottom));
  draw_bar(panel, bar);
  draw_ticks(panel, bar, minimum, maximum, letters);
  cv::Mat result;
  cv::hconcat(image, panel, result);
  return result;
}

}  // namespace dressform
