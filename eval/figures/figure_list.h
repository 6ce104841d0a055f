#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/reconstruct.h"
#include "render/charts/panels.h"
#include "render/renderer.h"

namespace dressform {

// What a figure of the thesis is made from: one run's results, and nothing that the pipeline did not have.
struct FigureInput {
  const Reconstruction& made;
  const CaptureSession& session;
  Renderer& renderer;
  std::string scene;
};

// A figure, or why this run cannot show it.
struct MadeFigure {
  std::optional<PanelFigure> figure;
  std::string reason;
};

struct ThesisFigure {
  std::string number;  // "3.13"
  std::string name;    // "registered_views": of its files, with the number before it
  std::string stage;   // whose result it shows; "capture" for the session's own pictures
  std::string shows;
  // Null where no run can show it; then `reason` says why.
  std::function<MadeFigure(const FigureInput&)> make;
  std::string reason;

  std::string stem() const { return "fig" + number + "_" + name; }
};

// Figures 3.2 to 3.40 and 4.1 to 4.17, each once, in their order.
const std::vector<ThesisFigure>& thesis_figures_list();

// The figure of a number ("3.13") or name. Throws InputError naming the numbers and names there are.
const ThesisFigure& thesis_figure(const std::string& number_or_name);

// Makes it; what is missing becomes a reason, never a figure with nothing in it.
MadeFigure made_figure(const ThesisFigure& figure, const FigureInput& input);

}  // namespace dressform
