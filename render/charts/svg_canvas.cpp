#include "render/charts/svg_canvas.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "render/charts/markup.h"
#include "render/charts/style.h"

namespace dressform {
namespace {

std::string svg_points(const Canvas::Points& points) {
  std::string text;
  for (const auto& p : points) text += fmt::format("{:.3f},{:.3f} ", p.x(), p.y());
  return text;
}

std::string svg_color(const Ink& ink) { return fmt::format("rgb({},{},{})", ink.red, ink.green, ink.blue); }

}  // namespace

SvgCanvas::SvgCanvas(double width_mm, double height_mm, const std::string& label)
    : svg_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.2f}mm\" height=\"{1:.2f}mm\" "
                       "viewBox=\"0 0 {0:.2f} {1:.2f}\" font-family=\"{2}, Verdana, sans-serif\"{3}>\n"
                       "<rect width=\"{0:.2f}\" height=\"{1:.2f}\" fill=\"white\"/>\n",
                       width_mm, height_mm, kFontFamily,
                       label.empty() ? "" : " role=\"img\" aria-label=\"" + html_escaped(label) + "\"")) {}

void SvgCanvas::polyline(const Points& points, const Ink& ink, double width_mm, bool dashed) {
  const std::string dashes =
      dashed ? fmt::format(" stroke-dasharray=\"{:.3f} {:.3f}\"", kDashOn * width_mm, kDashOff * width_mm) : "";
  svg_ += fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-opacity=\"{:g}\" stroke-width=\"{:g}\" "
      "stroke-linejoin=\"round\"{}/>\n",
      svg_points(points), svg_color(ink), ink.opacity, width_mm, dashes);
}

void SvgCanvas::polygon(const Points& points, const Ink& ink) {
  svg_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"{:g}\"/>\n", svg_points(points),
                      svg_color(ink), ink.opacity);
}

void SvgCanvas::dot(const Eigen::Vector2d& centre, double radius_mm, const Ink& ink) {
  svg_ += fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:g}\" fill=\"{}\" fill-opacity=\"{:g}\"/>\n",
                      centre.x(), centre.y(), radius_mm, svg_color(ink), ink.opacity);
}

void SvgCanvas::text(const Eigen::Vector2d& at, const std::string& text, const Lettering& lettering) {
  static const char* anchors[] = {"start", "middle", "end"};
  const std::string turn =
      lettering.upward ? fmt::format(" transform=\"rotate(-90 {:.3f} {:.3f})\"", at.x(), at.y()) : "";
  svg_ +=
      fmt::format("<text x=\"{:.3f}\" y=\"{:.3f}\" font-size=\"{:g}\" text-anchor=\"{}\" fill=\"{}\"{}{}>{}</text>\n",
                  at.x(), at.y(), lettering.size_mm, anchors[lettering.anchor], svg_color(lettering.ink),
                  lettering.bold ? " font-weight=\"bold\"" : "", turn, html_escaped(text));
}

void SvgCanvas::picture(const Eigen::Vector2d& corner, const Eigen::Vector2d& size_mm, const cv::Mat& bgr) {
  if (bgr.empty()) return;
  std::vector<unsigned char> bytes;
  cv::imencode(".png", bgr, bytes);
  svg_ += fmt::format(
      "<image x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" preserveAspectRatio=\"none\" "
      "href=\"data:image/png;base64,{}\"/>\n",
      corner.x(), corner.y(), size_mm.x(), size_mm.y(), base64(std::string(bytes.begin(), bytes.end())));
}

}  // namespace dressform
