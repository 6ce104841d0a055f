#include "render/charts/panels.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "render/color_map.h"
#include "render/ticks.h"

namespace dressform {
namespace {

using Eigen::Vector2d;

constexpr double kBarMm = 3, kTickMm = 1;

std::vector<std::pair<double, std::string>> scale_ticks(const ColorScale& scale) {
  const double step = round_step(scale.maximum - scale.minimum, 5);
  std::vector<std::pair<double, std::string>> ticks;
  for (double k = std::ceil(scale.minimum / step - 1e-9); k * step <= scale.maximum + 1e-9 * step; ++k)
    ticks.push_back({k * step, tick_text(k * step, step)});
  return ticks;
}

std::string scale_heading(const ColorScale& scale) {
  return scale.unit.empty() ? scale.title : scale.title + " [" + scale.unit + "]";
}

struct PlacedPanel {
  cv::Mat picture;
  Vector2d corner, size;
  std::string label;
};
struct PlacedSide {
  Vector2d at;
  std::string text;
};

// All places of a figure, millimetres.
struct PanelLayout {
  std::vector<PlacedPanel> panels;
  std::vector<PlacedSide> sides;
  double height = 0, scale_x = 0, scale_top = 0, scale_height = 0;

  PanelLayout(const PanelFigure& figure, const FigureStyle& style) {
    const bool any_side =
        std::any_of(figure.rows.begin(), figure.rows.end(), [](const auto& r) { return !r.side.empty(); });
    const double left = any_side ? 1.6 * style.letters_mm : 0;
    const double right =
        style.width_mm - (figure.scale ? color_scale_width_mm(*figure.scale, style) + style.gap_mm : 0);
    for (const auto& row : figure.rows) place(row, left, right, figure.lettered, style);
    height -= style.gap_mm;
    scale_x = right + style.gap_mm;
    scale_height = std::min(height, kTallestRowMm);
    scale_top = 0.5 * (height - scale_height);
  }

 private:
  void place(const PanelRow& row, double left, double right, bool lettered, const FigureStyle& style) {
    double aspects = 0;
    std::size_t count = 0;
    for (const auto& panel : row.panels)
      if (!panel.picture.empty()) aspects += static_cast<double>(panel.picture.cols) / panel.picture.rows, ++count;
    if (count == 0) return;
    const double gaps = style.gap_mm * static_cast<double>(count - 1);
    const double row_height = std::min(kTallestRowMm, (right - left - gaps) / aspects);
    double x = left + 0.5 * (right - left - gaps - row_height * aspects);
    bool labelled = false;
    for (const auto& panel : row.panels) {
      if (panel.picture.empty()) continue;
      std::string label = lettered ? panel_letter(panels.size()) : "";
      if (!panel.label.empty()) label += (label.empty() ? "" : " ") + panel.label;
      labelled = labelled || !label.empty();
      const double width = row_height * panel.picture.cols / panel.picture.rows;
      panels.push_back({panel.picture, {x, height}, {width, row_height}, label});
      x += width + style.gap_mm;
    }
    if (!row.side.empty()) sides.push_back({{style.letters_mm, height + 0.5 * row_height}, row.side});
    height += row_height + (labelled ? 1.5 * style.letters_mm : 0) + style.gap_mm;
  }
};

}  // namespace

double color_scale_width_mm(const ColorScale& scale, const FigureStyle& style) {
  double widest = 0;
  for (const auto& [at, text] : scale_ticks(scale))
    widest = std::max(widest, text_width_mm(text, style.letters_mm * kSmallerLetters));
  return kBarMm + 2 * kTickMm + widest + 1.8 * style.letters_mm;  // the heading stands upright beside the ticks
}

void paint_color_scale(Canvas& canvas, const Vector2d& corner, double height_mm, const ColorScale& scale,
                       const FigureStyle& style) {
  cv::Mat colors;
  cv::flip(scalar_colors(), colors, 0);
  canvas.picture(corner, {kBarMm, height_mm}, colors);
  canvas.rectangle(corner, {kBarMm, height_mm}, kFrameInk, style.hair_mm);
  const double small = style.letters_mm * kSmallerLetters, x = corner.x() + kBarMm;
  for (const auto& [at, text] : scale_ticks(scale)) {
    const double y = corner.y() + height_mm * (1 - (at - scale.minimum) / (scale.maximum - scale.minimum));
    canvas.polyline({{x, y}, {x + kTickMm, y}}, kFrameInk, style.hair_mm);
    canvas.text({x + 1.5 * kTickMm, y + 0.36 * small}, text, {small});
  }
  canvas.text({corner.x() + color_scale_width_mm(scale, style) - 0.4 * style.letters_mm, corner.y() + 0.5 * height_mm},
              scale_heading(scale), {style.letters_mm, Lettering::middle, true});
}

std::string panel_letter(std::size_t place) {
  std::string letters;
  for (std::size_t rest = place + 1; rest > 0; rest = (rest - 1) / 26)
    letters.insert(letters.begin(), static_cast<char>('a' + (rest - 1) % 26));
  return "(" + letters + ")";
}

Sheet panel_sheet(const PanelFigure& figure, const FigureStyle& style) {
  const PanelLayout layout(figure, style);
  if (layout.panels.empty()) throw std::invalid_argument("panel_sheet: a figure needs a picture");
  const auto scale = figure.scale;
  return {style.width_mm, layout.height, figure.title, [layout, scale, style](Canvas& canvas) {
            for (const auto& panel : layout.panels) {
              canvas.picture(panel.corner, panel.size, panel.picture);
              const double below = panel.corner.y() + panel.size.y() + 1.15 * style.letters_mm;
              canvas.text({panel.corner.x() + 0.5 * panel.size.x(), below},
                          clipped_text(panel.label, style.letters_mm, panel.size.x() + style.gap_mm),
                          {style.letters_mm, Lettering::middle});
            }
            for (const auto& side : layout.sides)
              canvas.text(side.at, side.text, {style.letters_mm, Lettering::middle, true});
            if (scale)
              paint_color_scale(canvas, {layout.scale_x, layout.scale_top}, layout.scale_height, *scale, style);
          }};
}

}  // namespace dressform
