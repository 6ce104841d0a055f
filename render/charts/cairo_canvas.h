#pragma once
#include "render/charts/canvas.h"

struct _cairo;

namespace dressform {

// Draws into a Cairo context whose unit is already the millimetre. The context stays the caller's.
class CairoCanvas : public Canvas {
 public:
  explicit CairoCanvas(_cairo* context) : context_(context) {}
  void polyline(const Points& points, const Ink& ink, double width_mm, bool dashed) override;
  void polygon(const Points& points, const Ink& ink) override;
  void dot(const Eigen::Vector2d& centre, double radius_mm, const Ink& ink) override;
  void text(const Eigen::Vector2d& at, const std::string& text, const Lettering& lettering) override;
  void picture(const Eigen::Vector2d& corner, const Eigen::Vector2d& size_mm, const cv::Mat& bgr) override;

 private:
  void trace(const Points& points);
  void set(const Ink& ink);
  _cairo* context_;
};

// A line of text in the figures' font, written into an 8-bit BGR image; `at_px` is its left end on the base line.
void write_text(cv::Mat& bgr, const Eigen::Vector2d& at_px, const std::string& text, double size_px,
                const Ink& ink = kTextInk);

}  // namespace dressform
