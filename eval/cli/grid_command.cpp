#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/figures/grid_file.h"

namespace dressform {
namespace {

struct GridOptions : CommonOptions {
  std::filesystem::path grid;
  std::vector<std::string> formats{"png", "pdf"};
  double dpi = kFigureDpi;
};

int draw_grid(const GridOptions& options) {
  const ThreadLimit threads(options.threads);
  const GridFile grid = read_grid(options.grid);
  const auto folder = options.output.empty() ? std::filesystem::path(".") : options.output;
  const Sheet sheet = grid_sheet(grid_figure(grid), grid.column ? kColumnStyle : kPaperStyle);
  std::filesystem::create_directories(folder);
  for (const auto& file : write_sheet(sheet, folder, options.grid.stem().string(), options.formats, options.dpi))
    fmt::print("{}\n", (folder / file).string());
  return kSuccess;
}

Command add_grid_command(CLI::App& app) {
  auto options = std::make_shared<GridOptions>();
  auto* command = app.add_subcommand("grid", "A figure of rows and columns: runs, what of them is shown, views");
  command->add_option("grid", options->grid, "grid file (TOML)")->required();
  command->add_option("-o,--output", options->output, "folder for the figure, named as the grid file; default here");
  command->add_option("--format", options->formats, "png, pdf, svg, joined by commas (default png,pdf)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(sheet_formats()));
  command->add_option("--dpi", options->dpi, "of PNGs (default 300)")->check(CLI::Range(36, 1200));
  add_threads(*command, *options);
  command->footer("Example:\n  dressform grid comparison.toml -o figures\nThe format is described in eval/README.md.");
  return [options] { return draw_grid(*options); };
}

const RegisteredCommand registered_grid{97, add_grid_command};

}  // namespace
}  // namespace dressform
