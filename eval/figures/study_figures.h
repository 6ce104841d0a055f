#pragma once
#include <string>
#include <vector>

#include "eval/studies/study_results.h"
#include "render/charts/chart.h"
#include "render/charts/row_chart.h"

namespace dressform {

struct StudyFigure {
  std::string stem, shows;
  Sheet sheet;
  std::string reason;  // why there is none; empty where there is one
};

// Of every primary metric: paired differences (forest), values scene by scene, quality against time; and of every
// metric in millimetres or degrees the curve of how many scenes come within a bound.
std::vector<StudyFigure> study_figures(const StudyResults& results, const FigureStyle& style);

// The part of all scenes, of 0 to 1, whose value is at most (lower is better) or at least x; a scene that failed never
// is. Steps at each value: x and part before and after.
Curve success_curve(const std::string& name, int color, std::vector<double> values, int scenes, Better better);

}  // namespace dressform
