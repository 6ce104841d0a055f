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

// What charts are drawn on: units of a pixel at 96 dpi, y down.
class Canvas {
 public:
  enum Anchor { left, middle, right };
  using Points = std::vector<Eigen::Vector2d>;

  virtual ~Canvas() = default;
  virtual void polyline(const Points& points, const Ink& ink, double width, bool dashed = false) = 0;
  virtual void polygon(const Points& points, const Ink& ink) = 0;
  virtual void dot(const Eigen::Vector2d& centre, double radius, const Ink& ink) = 0;
  // `at` is on the base line; upward text reads from below.
  virtual void text(const Eigen::Vector2d& at, const std::string& text, double size, Anchor anchor,
                    bool upward = false) = 0;
};

class SvgCanvas : public Canvas {
 public:
  SvgCanvas(int width, int height);
  void polyline(const Points& points, const Ink& ink, double width, bool dashed) override;
  void polygon(const Points& points, const Ink& ink) override;
  void dot(const Eigen::Vector2d& centre, double radius, const Ink& ink) override;
  void text(const Eigen::Vector2d& at, const std::string& text, double size, Anchor anchor, bool upward) override;
  std::string svg() const { return svg_ + "</svg>"; }

 private:
  std::string svg_;
};

// Drawn at four times the size and reduced to twice.
class ImageCanvas : public Canvas {
 public:
  ImageCanvas(int width, int height);
  void polyline(const Points& points, const Ink& ink, double width, bool dashed) override;
  void polygon(const Points& points, const Ink& ink) override;
  void dot(const Eigen::Vector2d& centre, double radius, const Ink& ink) override;
  void text(const Eigen::Vector2d& at, const std::string& text, double size, Anchor anchor, bool upward) override;
  cv::Mat image() const;

 private:
  cv::Mat large_;
};

}  // namespace dressform
