#pragma once

namespace dressform {

// How charts, panels and grids look: the one place. Lengths in millimetres on paper.
struct FigureStyle {
  double width_mm;       // of a whole figure
  double chart_part;     // height of a chart as a part of its width
  double letters_mm;     // size of axis labels and panel letters; ticks and legends are a step smaller
  double line_mm;        // of curves
  double hair_mm;        // of frames and ticks
  double gap_mm;         // between panels
  bool title_in_figure;  // on paper the title belongs to the caption
};

// On a page: the text width of a two-column journal, 7.5 pt letters.
constexpr FigureStyle kPaperStyle{178, 0.5, 2.65, 0.30, 0.15, 2.0, false};
// One column of it.
constexpr FigureStyle kColumnStyle{86, 0.72, 2.65, 0.30, 0.15, 1.5, false};
// In a report: 720 pixels at 96 dpi, 13 pixel letters.
constexpr FigureStyle kScreenStyle{190.5, 400.0 / 720, 3.44, 0.476, 0.265, 2.0, true};

constexpr const char* kFontFamily = "DejaVu Sans";  // Debian's fonts-dejavu-core: has Greek letters and signs
constexpr double kSmallerLetters = 12.0 / 13;       // ticks and legends beside labels
constexpr double kDashOn = 4, kDashOff = 2.7;       // dashes in line widths: they read at any size
constexpr double kFigureDpi = 300;                  // what journals ask of pictures
constexpr double kScreenDpi = 192;                  // of a chart's PNG: twice a screen's pixels
constexpr double kMmPerInch = 25.4;

}  // namespace dressform
