#pragma once
#include <string>

#include "eval/figures/figure_list.h"

namespace dressform {

// Figures of clouds, surfaces and textures on the mannequin: 3.13 to 3.33 and 4.5 to 4.8.
MadeFigure registered_figure(const FigureInput& input);
MadeFigure cloud_cleaning_figure(const FigureInput& input);
MadeFigure missing_points_figure(const FigureInput& input);
MadeFigure closed_figure(const FigureInput& input);
MadeFigure captured_and_closed_figure(const FigureInput& input);
MadeFigure rough_color_figure(const FigureInput& input);
MadeFigure boundary_figure(const FigureInput& input);
MadeFigure rim_figure(const FigureInput& input, const std::string& slot);
MadeFigure opened_figure(const FigureInput& input);
MadeFigure texture_map_figure(const FigureInput& input);
MadeFigure textured_figure(const FigureInput& input, const std::string& slot);
MadeFigure alignment_steps_figure(const FigureInput& input);
MadeFigure surface_steps_figure(const FigureInput& input);
MadeFigure opening_steps_figure(const FigureInput& input);
MadeFigure texturing_figure(const FigureInput& input);

}  // namespace dressform
