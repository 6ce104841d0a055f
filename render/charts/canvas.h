#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace dressform {

struct Ink {
  int red = 0, green = 0, blue = 0;
  double opacity = 1;
};
constexpr Ink kTextInk{34, 34, 34, 1}, kFrameInk{60, 60, 60, 1}, kWhite{255, 255, 255, 1};

// Okabe and Ito's colours, which stay apart for the colour-blind; 0 is near black, for references.
Ink palette_ink(int color, double opacity = 1);

struct Lettering {
  double size_mm = 2.65;
  enum Anchor { left, middle, right } anchor = left;
  bool upward = false;  // reads from below
  bool bold = false;
  Ink ink = kTextInk;
};

// What charts, panels and grids are drawn on: millimetres, y down, from the top left corner of a white page.
class Canvas {
 public:
  using Points = std::vector<Eigen::Vector2d>;

  virtual ~Canvas() = default;
  virtual void polyline(const Points& points, const Ink& ink, double width_mm, bool dashed = false) = 0;
  virtual void polygon(const Points& points, const Ink& ink) = 0;
  virtual void dot(const Eigen::Vector2d& centre, double radius_mm, const Ink& ink) = 0;
  // `at` is on the base line.
  virtual void text(const Eigen::Vector2d& at, const std::string& text, const Lettering& lettering) = 0;
  // 8-bit BGR, fitted into the box as it is (the caller keeps the aspect).
  virtual void picture(const Eigen::Vector2d& corner, const Eigen::Vector2d& size_mm, const cv::Mat& bgr) = 0;

  void rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size_mm, const Ink& ink, double width_mm);
};

// Advance of a line of text in the figures' font, millimetres.
double text_width_mm(const std::string& text, double size_mm, bool bold = false);

// Text cut to a width, with an ellipsis where it was cut; lines of whole words for `wrapped_text`.
std::string clipped_text(const std::string& text, double size_mm, double width_mm);
std::vector<std::string> wrapped_text(const std::string& text, double size_mm, double width_mm);

}  // namespace dressform
