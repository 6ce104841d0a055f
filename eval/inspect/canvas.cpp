#include "eval/inspect/canvas.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "eval/report/html.h"

namespace dressform {
namespace {

constexpr int kShift = 6;  // sub-pixel bits of OpenCV's drawing
constexpr double kLarge = 4, kDash = 6, kGap = 4;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

std::string svg_points(const Canvas::Points& points) {
  std::string text;
  for (const auto& p : points) text += fmt::format("{:.2f},{:.2f} ", p.x(), p.y());
  return text;
}

std::string svg_color(const Ink& ink) { return fmt::format("rgb({},{},{})", ink.red, ink.green, ink.blue); }

cv::Scalar bgr(const Ink& ink) { return cv::Scalar(ink.blue, ink.green, ink.red); }

cv::Point fixed_point(const Eigen::Vector2d& p) {
  const double factor = kLarge * (1 << kShift), half = 0.5 * (1 << kShift);  // pixel centres at integers
  return {static_cast<int>(std::lround(p.x() * factor - half)), static_cast<int>(std::lround(p.y() * factor - half))};
}

std::vector<cv::Point> fixed_points(const Canvas::Points& points) {
  std::vector<cv::Point> result;
  for (const auto& p : points) result.push_back(fixed_point(p));
  return result;
}

// The pieces of a line that are drawn when it is dashed.
std::vector<Canvas::Points> dashes(const Canvas::Points& points) {
  std::vector<Canvas::Points> pieces;
  double at = 0;  // along the pattern
  bool down = false;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d step = points[i] - points[i - 1];
    const double length = step.norm();
    for (double done = 0; done < length;) {
      const bool dash = at < kDash;
      const double part = std::min(length - done, (dash ? kDash : kDash + kGap) - at + 1e-9);
      if (dash) {
        if (!down) pieces.push_back({points[i - 1] + step * (done / length)});
        pieces.back().push_back(points[i - 1] + step * ((done + part) / length));
      }
      done += part, at = std::fmod(at + part, kDash + kGap);
      down = dash && at < kDash && at > 0;
    }
  }
  return pieces;
}

// OpenCV's letters are plain: what they lack in words.
std::string plain(std::string text) {
  const std::pair<const char*, const char*> words[] = {{"σ", "sigma"}, {"θ", "theta"}, {"±", "+-"},
                                                       {"°", " deg"},  {"²", "^2"},    {"≤", "<="}};
  for (const auto& [letter, word] : words)
    for (auto at = text.find(letter); at != text.npos; at = text.find(letter))
      text.replace(at, std::string(letter).size(), word);
  return text;
}

}  // namespace

SvgCanvas::SvgCanvas(int width, int height)
    : svg_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                       "font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"{0}\" height=\"{1}\" "
                       "fill=\"white\"/>\n",
                       width, height)) {}

void SvgCanvas::polyline(const Points& points, const Ink& ink, double width, bool dashed) {
  svg_ +=
      fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-opacity=\"{}\" stroke-width=\"{}\"{}/>\n",
                  svg_points(points), svg_color(ink), ink.opacity, width,
                  dashed ? fmt::format(" stroke-dasharray=\"{} {}\"", kDash, kGap) : "");
}

void SvgCanvas::polygon(const Points& points, const Ink& ink) {
  svg_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"{}\"/>\n", svg_points(points), svg_color(ink),
                      ink.opacity);
}

void SvgCanvas::dot(const Eigen::Vector2d& centre, double radius, const Ink& ink) {
  svg_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\"/>\n", centre.x(), centre.y(), radius,
                      svg_color(ink));
}

void SvgCanvas::text(const Eigen::Vector2d& at, const std::string& text, double size, Anchor anchor, bool upward) {
  static const char* anchors[] = {"start", "middle", "end"};
  const std::string turn = upward ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", at.x(), at.y()) : "";
  svg_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"#222\"{}>{}</text>\n",
                      at.x(), at.y(), size, anchors[anchor], turn, html_escaped(text));
}

ImageCanvas::ImageCanvas(int width, int height)
    : large_(static_cast<int>(kLarge * height), static_cast<int>(kLarge * width), CV_8UC3, cv::Scalar::all(255)) {}

void ImageCanvas::polyline(const Points& points, const Ink& ink, double width, bool dashed) {
  for (const auto& piece : dashed ? dashes(points) : std::vector<Points>{points})
    cv::polylines(large_, fixed_points(piece), false, bgr(ink),
                  std::max(1, static_cast<int>(std::lround(kLarge * width))), cv::LINE_AA, kShift);
}

void ImageCanvas::polygon(const Points& points, const Ink& ink) {
  cv::Mat filled = large_.clone();
  cv::fillPoly(filled, std::vector<std::vector<cv::Point>>{fixed_points(points)}, bgr(ink), cv::LINE_AA, kShift);
  cv::addWeighted(filled, ink.opacity, large_, 1 - ink.opacity, 0, large_);
}

void ImageCanvas::dot(const Eigen::Vector2d& centre, double radius, const Ink& ink) {
  cv::circle(large_, fixed_point(centre), static_cast<int>(std::lround(radius * kLarge * (1 << kShift))), bgr(ink),
             cv::FILLED, cv::LINE_AA, kShift);
}

void ImageCanvas::text(const Eigen::Vector2d& at, const std::string& text, double size, Anchor anchor, bool upward) {
  const std::string letters = plain(text);
  const double scale = kLarge * size / 31;  // the font's letters are 22 high at scale 1
  const int thickness = std::max(1, static_cast<int>(std::lround(0.08 * kLarge * size)));
  int below = 0;
  const cv::Size extent = cv::getTextSize(letters, kFont, scale, thickness, &below);
  const double back = anchor == left ? 0 : anchor == middle ? 0.5 * extent.width : extent.width;
  const cv::Scalar ink = cv::Scalar::all(34);
  if (!upward) {
    const cv::Point start(static_cast<int>(kLarge * at.x() - back), static_cast<int>(kLarge * at.y()));
    return cv::putText(large_, letters, start, kFont, scale, ink, thickness, cv::LINE_AA);
  }
  const int margin = thickness + below;
  cv::Mat line(extent.height + 2 * margin, extent.width + 2 * margin, CV_8UC3, cv::Scalar::all(255)), turned;
  cv::putText(line, letters, {margin, extent.height + margin}, kFont, scale, ink, thickness, cv::LINE_AA);
  cv::rotate(line, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect place(static_cast<int>(kLarge * at.x()) - extent.height - margin,
                       static_cast<int>(kLarge * at.y() + back) - extent.width - margin, turned.cols, turned.rows);
  const cv::Rect inside = place & cv::Rect(0, 0, large_.cols, large_.rows);
  if (!inside.empty()) turned(inside - place.tl()).copyTo(large_(inside));
}

cv::Mat ImageCanvas::image() const {
  cv::Mat result;
  cv::resize(large_, result, {}, 0.5, 0.5, cv::INTER_AREA);
  return result;
}

}  // namespace dressform
