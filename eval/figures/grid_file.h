#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "render/charts/grid_sheet.h"
#include "render/charts/style.h"

namespace dressform {

// What a row or a column says of its cells; a cell takes of each what the other leaves open.
struct GridChoice {
  std::string label;
  std::filesystem::path run;  // a run folder
  std::string show;           // "capture", "mannequin", "user", "error", "file"
  std::string slot;           // "top", "bottom"; empty: both
  std::string sensor;         // of "capture"; empty: the first one
  double view_deg = 0;        // of rendered pictures, about the vertical: 0 as the first sensor looks, 90 from the left
  bool has_view = false;
  std::string file;    // of "file": an image in the run's folder, "renders/result_user.png"
  std::string metric;  // "surface top/f_5mm@1": its value stands below the picture
};

struct GridFile {
  std::string title, caption;
  bool column = false;   // one column of a page; else its whole width
  double error_mm = 10;  // at the top of the colour scale of "error"
  int height_px = 700;   // of rendered pictures
  std::vector<GridChoice> rows, columns;
  std::vector<GridZoom> zooms;
};

// Reads a grid file (TOML; eval/README.md has the format). Throws InputError with file, line and column for unknown
// keys, wrong types, runs that are not there, and cells of which nothing says what they show.
GridFile read_grid(const std::filesystem::path& file);

// What a cell shows: the row's choices, filled up by the column's.
GridChoice joined_choice(const GridChoice& row, const GridChoice& column);

// Makes the pictures. A run that lacks what a cell shows (a garment that was not made) gives an empty cell that says
// so. Throws InputError naming the run and file for a metric it does not have and for damaged files.
GridFigure grid_figure(const GridFile& grid);

}  // namespace dressform
