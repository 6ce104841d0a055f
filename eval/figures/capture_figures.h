#pragma once
#include <string>
#include <vector>

#include "eval/figures/figure_list.h"

namespace dressform {

// Figures in the cameras' images: 3.2 to 3.12 and 4.1 to 4.4.
MadeFigure board_figure(const FigureInput& input);
MadeFigure extraction_figure(const FigureInput& input, const std::vector<std::string>& sides);
MadeFigure region_figure(const FigureInput& input);
MadeFigure labelled_figure(const FigureInput& input, const std::string& slot);
MadeFigure armpit_figure(const FigureInput& input);
MadeFigure cleaned_figure(const FigureInput& input, const std::string& slot);
MadeFigure filling_figure(const FigureInput& input, const std::string& slot);
MadeFigure view_extraction_figure(const FigureInput& input, const std::string& side);

}  // namespace dressform
