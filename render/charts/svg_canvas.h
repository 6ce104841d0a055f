#pragma once
#include <string>

#include "render/charts/canvas.h"

namespace dressform {

// Draws as SVG text: letters stay letters (found, copied and read aloud, also where the drawing stands inside a page),
// pictures are embedded PNGs. `label` is what a reader who cannot see it is told; empty: nothing.
class SvgCanvas : public Canvas {
 public:
  SvgCanvas(double width_mm, double height_mm, const std::string& label);
  void polyline(const Points& points, const Ink& ink, double width_mm, bool dashed) override;
  void polygon(const Points& points, const Ink& ink) override;
  void dot(const Eigen::Vector2d& centre, double radius_mm, const Ink& ink) override;
  void text(const Eigen::Vector2d& at, const std::string& text, const Lettering& lettering) override;
  void picture(const Eigen::Vector2d& corner, const Eigen::Vector2d& size_mm, const cv::Mat& bgr) override;
  std::string svg() const { return svg_ + "</svg>"; }

 private:
  std::string svg_;
};

}  // namespace dressform
