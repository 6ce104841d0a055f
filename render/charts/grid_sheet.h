#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "render/charts/panels.h"

namespace dressform {

struct GridCell {
  cv::Mat picture;   // 8-bit BGR; empty: the cell says `note` alone ("failed")
  std::string note;  // below the picture: a metric's value
};
// A part that every cell shows enlarged below its picture: in parts of its width and height.
struct GridZoom {
  double x = 0, y = 0, width = 0, height = 0;
};
struct GridFigure {
  std::string title, caption;
  std::vector<std::string> columns, rows;    // their labels
  std::vector<std::vector<GridCell>> cells;  // [row][column]
  std::vector<GridZoom> zooms;
  std::optional<ColorScale> scale;
};

// Pictures of a row are one height, columns one width. Throws std::invalid_argument where cells are missing or a zoom
// leaves the picture.
Sheet grid_sheet(const GridFigure& figure, const FigureStyle& style = kPaperStyle);

}  // namespace dressform
