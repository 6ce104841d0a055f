#pragma once
#include "eval/figures/figure_list.h"

namespace dressform {

// Figures of the user and of clothes on bodies: 3.34 to 3.40 and 4.9 to 4.17. A run without a scan of the user has
// none.
MadeFigure user_figure(const FigureInput& input);
MadeFigure two_bodies_figure(const FigureInput& input);
MadeFigure deformed_body_figure(const FigureInput& input);
MadeFigure resized_figure(const FigureInput& input);
MadeFigure compared_figure(const FigureInput& input);

}  // namespace dressform
