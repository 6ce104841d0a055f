#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "render/charts/sheet.h"
#include "render/charts/style.h"

namespace dressform {

// The colours of Shading::scalar with ticks, beside pictures drawn with them.
struct ColorScale {
  double minimum = 0, maximum = 1;
  std::string title, unit;
};
// What a colour scale needs beside the pictures, ticks and title included.
double color_scale_width_mm(const ColorScale& scale, const FigureStyle& style);
void paint_color_scale(Canvas& canvas, const Eigen::Vector2d& corner, double height_mm, const ColorScale& scale,
                       const FigureStyle& style);

// A picture of a figure in parts. Its letter, "(a)", is given by its place.
struct Panel {
  cv::Mat picture;    // 8-bit BGR
  std::string label;  // a few words behind the letter; may be empty
};
struct PanelRow {
  std::vector<Panel> panels;  // brought to one height, side by side
  std::string side;           // at the left, read upwards: what the row has in common; may be empty
};
struct PanelFigure {
  std::string title;
  std::vector<PanelRow> rows;
  std::optional<ColorScale> scale;
  bool lettered = true;
};

constexpr double kTallestRowMm = 80;  // three such rows fill a journal's page

// Rows as wide as the figure, or as high as kTallestRowMm. Throws std::invalid_argument for a figure without pictures.
Sheet panel_sheet(const PanelFigure& figure, const FigureStyle& style = kPaperStyle);

// "(a)" to "(z)", then "(aa)".
std::string panel_letter(std::size_t place);

}  // namespace dressform
