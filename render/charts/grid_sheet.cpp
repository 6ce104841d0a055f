#include "render/charts/grid_sheet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dressform {
namespace {

using Eigen::Vector2d;

void check_grid(const GridFigure& figure) {
  if (figure.rows.empty() || figure.columns.empty() || figure.cells.size() != figure.rows.size())
    throw std::invalid_argument("grid_sheet: rows and columns with a cell each are needed");
  for (const auto& row : figure.cells)
    if (row.size() != figure.columns.size())
      throw std::invalid_argument("grid_sheet: a row has not as many cells as there are columns");
  for (const auto& zoom : figure.zooms)
    if (!(zoom.x >= 0 && zoom.y >= 0 && zoom.width > 0 && zoom.height > 0 && zoom.x + zoom.width <= 1 &&
          zoom.y + zoom.height <= 1))
      throw std::invalid_argument("grid_sheet: a zoom leaves the picture");
}

class GridPainter {
 public:
  GridPainter(const GridFigure& figure, const FigureStyle& style) : figure_(figure), style_(style) {
    left_ = 1.6 * style.letters_mm;
    right_ = style.width_mm - (figure.scale ? color_scale_width_mm(*figure.scale, style) + style.gap_mm : 0);
    const double count = static_cast<double>(figure.columns.size());
    cell_ = (right_ - left_ - style.gap_mm * (count - 1)) / count;
    double y = top_ = 1.6 * style.letters_mm;
    for (const auto& row : figure.cells) {
      row_top_.push_back(y);
      picture_.push_back(picture_height(row));
      y += picture_.back() + zoom_height() + note_height(row) + style.gap_mm;
    }
    cells_bottom_ = y - style.gap_mm;
    caption_ = wrapped_text(figure.caption, style.letters_mm, style.width_mm);
  }

  double height() const {
    return cells_bottom_ + (caption_.empty() ? 0 : (static_cast<double>(caption_.size()) + 0.6) * line());
  }

  void paint(Canvas& canvas) const {
    for (std::size_t c = 0; c < figure_.columns.size(); ++c)
      canvas.text({x_of(c) + 0.5 * cell_, 1.1 * style_.letters_mm},
                  clipped_text(figure_.columns[c], style_.letters_mm, cell_),
                  {style_.letters_mm, Lettering::middle, false, true});
    for (std::size_t r = 0; r < figure_.rows.size(); ++r) {
      canvas.text({style_.letters_mm, row_top_[r] + 0.5 * picture_[r]},
                  clipped_text(figure_.rows[r], style_.letters_mm, std::max(picture_[r], 6 * style_.letters_mm)),
                  {style_.letters_mm, Lettering::middle, true, true});
      for (std::size_t c = 0; c < figure_.columns.size(); ++c) paint_cell(canvas, r, c);
    }
    if (figure_.scale)
      paint_color_scale(canvas, {right_ + style_.gap_mm, top_}, std::min(cells_bottom_ - top_, kTallestRowMm),
                        *figure_.scale, style_);
    for (std::size_t i = 0; i < caption_.size(); ++i)
      canvas.text({0, cells_bottom_ + (static_cast<double>(i) + 1.3) * line()}, caption_[i], {style_.letters_mm});
  }

 private:
  static constexpr double kZoomFrameMm = 0.4;
  double line() const { return 1.35 * style_.letters_mm; }
  double x_of(std::size_t column) const { return left_ + static_cast<double>(column) * (cell_ + style_.gap_mm); }

  // So high that the tallest picture of the row is as wide as its column.
  double picture_height(const std::vector<GridCell>& row) const {
    double highest = 0;
    for (const auto& cell : row)
      if (!cell.picture.empty()) highest = std::max(highest, cell_ * cell.picture.rows / cell.picture.cols);
    return highest > 0 ? std::min(highest, kTallestRowMm) : 4 * style_.letters_mm;
  }
  double zoom_height() const { return figure_.zooms.empty() ? 0 : zoom_side() + 0.5 * style_.gap_mm; }
  double zoom_side() const {
    const double count = static_cast<double>(figure_.zooms.size());
    return (cell_ - 0.5 * style_.gap_mm * (count - 1)) / std::max(2.0, count);
  }
  double note_height(const std::vector<GridCell>& row) const {
    return std::any_of(row.begin(), row.end(), [](const auto& cell) { return !cell.note.empty(); }) ? line() : 0;
  }

  void paint_cell(Canvas& canvas, std::size_t r, std::size_t c) const {
    const GridCell& cell = figure_.cells[r][c];
    const double x = x_of(c), y = row_top_[r], middle = x + 0.5 * cell_;
    const double note_at = y + picture_[r] + zoom_height() + 1.0 * style_.letters_mm;
    if (cell.picture.empty()) {
      canvas.rectangle({x, y}, {cell_, picture_[r]}, {200, 200, 200, 1}, style_.hair_mm);
      canvas.text({middle, y + 0.5 * picture_[r]}, clipped_text(cell.note, style_.letters_mm, cell_),
                  {style_.letters_mm, Lettering::middle});
      return;
    }
    const double scale = std::min(cell_ / cell.picture.cols, picture_[r] / cell.picture.rows);
    const Vector2d size(scale * cell.picture.cols, scale * cell.picture.rows);
    const Vector2d corner(middle - 0.5 * size.x(), y + 0.5 * (picture_[r] - size.y()));
    canvas.picture(corner, size, cell.picture);
    for (std::size_t z = 0; z < figure_.zooms.size(); ++z)
      paint_zoom(canvas, cell.picture, corner, size, {x, y + picture_[r]}, z);
    if (!cell.note.empty())
      canvas.text({middle, note_at}, clipped_text(cell.note, style_.letters_mm, cell_ + style_.gap_mm),
                  {style_.letters_mm, Lettering::middle});
  }

  // The frame in the picture and, below it, what is in the frame; both in the zoom's colour.
  void paint_zoom(Canvas& canvas, const cv::Mat& picture, const Vector2d& corner, const Vector2d& size,
                  const Vector2d& below, std::size_t number) const {
    const GridZoom& zoom = figure_.zooms[number];
    const Ink ink = palette_ink(static_cast<int>(2 + number));
    canvas.rectangle(corner + Vector2d(zoom.x * size.x(), zoom.y * size.y()),
                     {zoom.width * size.x(), zoom.height * size.y()}, ink, kZoomFrameMm);
    const cv::Rect part = cv::Rect(static_cast<int>(zoom.x * picture.cols), static_cast<int>(zoom.y * picture.rows),
                                   std::max(1, static_cast<int>(zoom.width * picture.cols)),
                                   std::max(1, static_cast<int>(zoom.height * picture.rows))) &
                          cv::Rect(0, 0, picture.cols, picture.rows);
    const double side = zoom_side(), fit = side / std::max(part.width, part.height);
    const Vector2d shown(fit * part.width, fit * part.height);
    const double count = static_cast<double>(figure_.zooms.size()), step = side + 0.5 * style_.gap_mm;
    const double first = below.x() + 0.5 * (cell_ - count * step + 0.5 * style_.gap_mm);
    const double x =
        first + static_cast<double>(number) * step + 0.5 * (side - shown.x());  // in the middle of its place
    const Vector2d at(x, below.y() + 0.5 * style_.gap_mm);
    canvas.picture(at, shown, picture(part).clone());
    canvas.rectangle(at, shown, ink, kZoomFrameMm);
  }

  GridFigure figure_;
  FigureStyle style_;
  double left_ = 0, right_ = 0, cell_ = 0, top_ = 0, cells_bottom_ = 0;
  std::vector<double> row_top_, picture_;
  std::vector<std::string> caption_;
};

}  // namespace

Sheet grid_sheet(const GridFigure& figure, const FigureStyle& style) {
  check_grid(figure);
  const GridPainter painter(figure, style);
  return {style.width_mm, painter.height(), figure.title, [painter](Canvas& canvas) { painter.paint(canvas); }};
}

}  // namespace dressform
