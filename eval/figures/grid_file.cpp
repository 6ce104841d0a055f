#include "eval/figures/grid_file.h"

#include <fmt/format.h>

#include "scenes/toml_section.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

GridChoice read_choice(TomlSection& section) {
  GridChoice choice;
  section("label", choice.label, {}, "");
  if (const toml::node* run = section.find("run")) {
    if (!run->is_string()) section.fail("run", "expected a run folder");
    choice.run = fs::absolute(resolved_path(*run, run->as_string()->get() + "/run.json")).parent_path();
  }
  section("show", choice.show, {"capture", "mannequin", "user", "error", "image"}, "");
  section("slot", choice.slot, {"top", "bottom"}, "");
  section("sensor", choice.sensor, {}, "");
  choice.has_view = section.has("view_deg");
  section("view_deg", choice.view_deg, -360, 360, "deg", "");
  section("image", choice.file, {}, "");
  section("metric", choice.metric, {}, "");
  if (!choice.file.empty() && choice.show.empty()) choice.show = "image";
  return choice;
}

void check_cell(const fs::path& file, const GridChoice& cell, std::size_t row, std::size_t column) {
  const auto fail = [&](const std::string& problem) {
    throw InputError(file.string(), fmt::format("row {}, column {}: {}", row + 1, column + 1, problem));
  };
  if (cell.run.empty()) fail("found no run; expected one in the row or the column");
  if (cell.show.empty()) fail("found no show; expected capture, mannequin, user, error or image");
  if (cell.show == "image" && cell.file.empty()) fail("found no image; expected a file of the run's folder");
}

}  // namespace

GridChoice joined_choice(const GridChoice& row, const GridChoice& column) {
  GridChoice cell = row;
  const auto take = [](auto& mine, const auto& other) {
    if (mine.empty()) mine = other;
  };
  take(cell.run, column.run), take(cell.show, column.show), take(cell.slot, column.slot);
  take(cell.sensor, column.sensor), take(cell.file, column.file), take(cell.metric, column.metric);
  if (!cell.has_view) cell.view_deg = column.view_deg, cell.has_view = column.has_view;
  return cell;
}

GridFile read_grid(const fs::path& file) {
  TomlFiles files;
  TomlSection section(files, files.open(file, file.filename().string(), ""), "");
  GridFile grid;
  std::string width = "page";
  section("title", grid.title, {}, "");
  section("caption", grid.caption, {}, "");
  section("width", width, {"page", "column"}, "");
  section("error_mm", grid.error_mm, 0.1, 1000, "mm", "");
  section("height_px", grid.height_px, 64, 4096, "px", "");
  grid.column = width == "column";
  section.children("row", [&](TomlSection& row) { grid.rows.push_back(read_choice(row)); });
  section.children("column", [&](TomlSection& column) { grid.columns.push_back(read_choice(column)); });
  section.children("zoom", [&](TomlSection& part) {
    GridZoom zoom;
    part("x", zoom.x, 0, 1, "", "");
    part("y", zoom.y, 0, 1, "", "");
    part("width", zoom.width, 0.001, 1, "", "");
    part("height", zoom.height, 0.001, 1, "", "");
    if (zoom.width <= 0 || zoom.height <= 0 || zoom.x + zoom.width > 1 || zoom.y + zoom.height > 1)
      part.fail("", "leaves the picture; expected x, y, width and height in parts of it");
    grid.zooms.push_back(zoom);
  });
  section.finish();
  if (grid.rows.empty() || grid.columns.empty())
    throw InputError(file.string(), "found no [[row]] or no [[column]]; expected one of each at least");
  for (std::size_t r = 0; r < grid.rows.size(); ++r)
    for (std::size_t c = 0; c < grid.columns.size(); ++c)
      check_cell(file, joined_choice(grid.rows[r], grid.columns[c]), r, c);
  return grid;
}

}  // namespace dressform
