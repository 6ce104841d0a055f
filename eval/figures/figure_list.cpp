#include "eval/figures/figure_list.h"

#include <algorithm>

#include "eval/figures/capture_figures.h"
#include "eval/figures/fit_figures.h"
#include "eval/figures/shape_figures.h"
#include "scenes/error.h"

namespace dressform {
namespace {

using Make = std::function<MadeFigure(const FigureInput&)>;

constexpr const char* kByHand = "points that a person picks by hand; a run does not keep them with its results";
constexpr const char* kStrips = "strips between picked points; textures here are charts of an atlas (figure 3.27)";

ThesisFigure shown(const std::string& number, const std::string& name, const std::string& stage,
                   const std::string& shows, const Make& make) {
  return {number, name, stage, shows, make, ""};
}

ThesisFigure unshown(const std::string& number, const std::string& name, const std::string& stage,
                     const std::string& shows, const std::string& reason) {
  return {number, name, stage, shows, nullptr, reason};
}

// For a function that takes one thing more.
template <class More>
Make with(MadeFigure (*make)(const FigureInput&, const More&), const More& more) {
  return [=](const FigureInput& input) { return make(input, more); };
}

Make slot(MadeFigure (*make)(const FigureInput&, const std::string&), const char* name) {
  return with<std::string>(make, name);
}

Make sides(const std::vector<std::string>& names) { return with<std::vector<std::string>>(extraction_figure, names); }

// The figure of one group of clothes, for runs of that scene.
Make of_group(int group, MadeFigure (*make)(const FigureInput&)) {
  return [=](const FigureInput& input) -> MadeFigure {
    const std::string scene = "group" + std::to_string(group);
    if (input.scene != scene) return {{}, "shows " + scene + "; the run's scene is " + input.scene};
    return make(input);
  };
}

std::vector<ThesisFigure> in_the_images() {
  return {
      shown("3.2", "checkerboard", "capture", "a checkerboard by both cameras", board_figure),
      shown("3.3", "extraction_front_back", "extract", "dressed mannequin, front and back", sides({"front", "back"})),
      shown("3.4", "extraction_left_right", "extract", "dressed mannequin, left and right", sides({"left", "right"})),
      shown("3.5", "regions", "segment", "JSEG's regions in four views", region_figure),
      shown("3.6", "shirt_extracted", "segment", "shirt in four views", slot(labelled_figure, "top")),
      shown("3.7", "bottom_extracted", "segment", "trousers or skirt in four views", slot(labelled_figure, "bottom")),
      shown("3.8", "armpit", "segment", "shirt with a zoom at the armpit", armpit_figure),
      shown("3.9", "shirt_cleaned", "fill", "shirt without artefacts", slot(cleaned_figure, "top")),
      shown("3.10", "bottom_cleaned", "fill", "trousers or skirt without artefacts", slot(cleaned_figure, "bottom")),
      shown("3.11", "shirt_filled", "fill", "shirt before and after region filling", slot(filling_figure, "top")),
      shown("3.12", "bottom_filled", "fill", "trousers before and after region filling",
            slot(filling_figure, "bottom")),
  };
}

std::vector<ThesisFigure> of_shapes() {
  return {
      shown("3.13", "registered", "registration", "model of the mannequin and registered views", registered_figure),
      shown("3.14", "clouds", "surface", "clouds before and after cleaning", cloud_cleaning_figure),
      shown("3.15", "missing_points", "surface", "gaps of the clouds", missing_points_figure),
      shown("3.16", "closed", "surface", "closed surfaces", closed_figure),
      shown("3.17", "captured_closed", "surface", "captured clothes beside their surfaces", captured_and_closed_figure),
      shown("3.18", "rough_colors", "surface", "surfaces in the nearest points' colours", rough_color_figure),
      unshown("3.19", "picked_points", "open", "points picked along the boundaries", kByHand),
      unshown("3.20", "removed_faces", "open", "faces removed between the picked points", kByHand),
      unshown("3.21", "removed_parts", "open", "parts removed beyond the boundaries",
              "what is cut away is not kept with a run's results"),
      unshown("3.22", "edge_vertex", "open", "what a boundary vertex is", "a drawing of a notion, of no run"),
      shown("3.23", "boundaries", "open", "boundaries of the clothes", boundary_figure),
      shown("3.24", "shirt_rims", "open", "the shirt's rims", slot(rim_figure, "top")),
      shown("3.25", "bottom_rims", "open", "the trousers' or skirt's rims", slot(rim_figure, "bottom")),
      shown("3.26", "opened", "open", "opened clothes", opened_figure),
      shown("3.27", "texture_maps", "texture", "texture maps", texture_map_figure),
      unshown("3.28", "shirt_strips", "texture", "the shirt cut into strips and parts", kStrips),
      unshown("3.29", "shirt_parts", "texture", "the shirt's four parts", kStrips),
      unshown("3.30", "bottom_strips", "texture", "the trousers cut into strips and parts", kStrips),
      unshown("3.31", "bottom_parts", "texture", "the trousers' four parts", kStrips),
      shown("3.32", "shirt_textured", "texture", "textured shirt", slot(textured_figure, "top")),
      shown("3.33", "bottom_textured", "texture", "textured trousers or skirt", slot(textured_figure, "bottom")),
  };
}

std::vector<ThesisFigure> on_the_user() {
  return {
      shown("3.34", "user", "fuse", "model of the user", user_figure),
      unshown("3.35", "parts_removed", "fit", "bodies without head, neck, hands and feet",
              "bodies are kept whole here; fit weighs their parts instead"),
      shown("3.36", "two_bodies", "fit", "mannequin and user in one place", two_bodies_figure),
      unshown("3.37", "control_points", "fit", "control points on the mannequin",
              "a run keeps how many there are (report.html), not where"),
      unshown("3.38", "target_points", "fit", "their places on the user",
              "a run keeps how many there are (report.html), not where"),
      shown("3.39", "deformed_body", "fit", "mannequin deformed to the user", deformed_body_figure),
      shown("3.40", "resized", "correct", "clothes on mannequin and user, before and after correction", resized_figure),
  };
}

std::vector<ThesisFigure> of_chapter_4() {
  std::vector<ThesisFigure> figures;
  int number = 1;
  const auto next = [&] { return "4." + std::to_string(number++); };
  for (const char* side : {"front", "back", "left", "right"})
    figures.push_back(shown(next(), std::string("extraction_") + side, "fill",
                            std::string("clothes extraction, ") + side + " view", slot(view_extraction_figure, side)));
  figures.push_back(shown(next(), "registration_steps", "registration", "registration of the naked mannequin",
                          alignment_steps_figure));
  figures.push_back(shown(next(), "surface_steps", "surface", "from views to surfaces", surface_steps_figure));
  figures.push_back(shown(next(), "opening_steps", "open", "from closed to open clothes", opening_steps_figure));
  figures.push_back(shown(next(), "texturing", "texture", "texture mapping", texturing_figure));
  figures.push_back(shown(next(), "body_deformed", "fit", "mannequin deformed to the user", deformed_body_figure));
  for (int group = 1; group <= 4; ++group)
    figures.push_back(shown(next(), "customised_group" + std::to_string(group), "correct",
                            "clothes of group " + std::to_string(group) + " on mannequin and user",
                            of_group(group, resized_figure)));
  for (int group = 1; group <= 4; ++group)
    figures.push_back(shown(next(), "compared_group" + std::to_string(group), "correct",
                            "captured and reconstructed clothes of group " + std::to_string(group),
                            of_group(group, compared_figure)));
  return figures;
}

}  // namespace

const std::vector<ThesisFigure>& thesis_figures_list() {
  static const std::vector<ThesisFigure> all = [] {
    std::vector<ThesisFigure> figures;
    for (const auto& part : {in_the_images(), of_shapes(), on_the_user(), of_chapter_4()})
      figures.insert(figures.end(), part.begin(), part.end());
    return figures;
  }();
  return all;
}

const ThesisFigure& thesis_figure(const std::string& number_or_name) {
  std::string known;
  for (const auto& figure : thesis_figures_list()) {
    if (figure.number == number_or_name || figure.name == number_or_name) return figure;
    known += (known.empty() ? "" : ", ") + figure.number + " " + figure.name;
  }
  throw InputError("--only " + number_or_name, "no such figure; expected a number or name of " + known);
}

MadeFigure made_figure(const ThesisFigure& figure, const FigureInput& input) {
  if (!figure.make) return {{}, figure.reason};
  MadeFigure made = figure.make(input);
  if (!made.figure) return made;
  const auto has_picture = [](const PanelRow& row) {
    return std::any_of(row.panels.begin(), row.panels.end(), [](const auto& panel) { return !panel.picture.empty(); });
  };
  if (!std::any_of(made.figure->rows.begin(), made.figure->rows.end(), has_picture))
    return {{}, figure.stage + " made nothing that could be shown"};
  return made;
}

}  // namespace dressform
