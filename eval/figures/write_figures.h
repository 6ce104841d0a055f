#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "eval/figures/figure_list.h"
#include "render/charts/style.h"

namespace dressform {

struct FigureFiles {
  std::vector<std::string> formats;  // of sheet_formats()
  double dpi = kFigureDpi;
};

// A figure that was asked for: its files, or why there are none.
struct FigureRecord {
  std::string number, name, stage, shows, reason;
  std::vector<std::string> files;
};

// A folder of figures, all or none of it: the figures and figures.md, which lists every one asked for with its files or
// the reason why there is none.
std::vector<FigureRecord> write_thesis_figures(const FigureInput& input,
                                               const std::vector<const ThesisFigure*>& figures,
                                               const FigureFiles& files, const std::filesystem::path& folder);
std::vector<FigureRecord> write_study_figures(const std::filesystem::path& study, const FigureFiles& files,
                                              const std::filesystem::path& folder);
std::string figures_markdown(const std::string& title, const std::vector<FigureRecord>& records);

}  // namespace dressform
