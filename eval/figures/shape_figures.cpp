#include "eval/figures/shape_figures.h"

#include "eval/figures/run_views.h"
#include "eval/figures/shape_pictures.h"
#include "eval/report/image_tools.h"
#include "eval/report/rim_marks.h"
#include "eval/report/stage_images.h"
#include "eval/report/turned.h"

namespace dressform {
namespace {

constexpr double kOblique = 25;  // degrees: enough to see that a thing is hollow
const char* const kSlots[] = {"top", "bottom"};

void add_panel(PanelRow& row, const cv::Mat& picture, const std::string& label) {
  if (!picture.empty()) row.panels.push_back({picture, label});
}

MadeFigure figure_of(const std::string& title, std::vector<PanelRow> rows, const std::string& reason) {
  rows.erase(std::remove_if(rows.begin(), rows.end(), [](const auto& row) { return row.panels.empty(); }), rows.end());
  if (rows.empty()) return {{}, reason};
  return {PanelFigure{title, std::move(rows), {}, true}, ""};
}

// A panel a garment, by what paints it.
template <class Paint>
MadeFigure by_garment(const std::string& title, const std::string& reason, const Paint& paint) {
  PanelRow row;
  for (const char* slot : kSlots) add_panel(row, paint(std::string(slot)), slot);
  return figure_of(title, {row}, reason);
}

}  // namespace

MadeFigure registered_figure(const FigureInput& input) {
  PanelRow row;
  const double heading = front_heading(input.made);
  const Mesh& body = input.made.naked.get().body;
  if (!body.triangles.empty()) add_panel(row, body_picture(input, body, heading, 0), "scanned model");
  add_panel(row, cloud_picture(input, naked_points(input), 0), "registered views");
  add_panel(row, cloud_picture(input, naked_points(input), 90), "from the left");
  return figure_of("Model of the naked mannequin, and its four views registered", {row}, "no view was registered");
}

MadeFigure cloud_cleaning_figure(const FigureInput& input) {
  std::vector<PanelRow> rows;
  for (const char* slot : kSlots) {
    rows.push_back({{}, slot});
    add_panel(rows.back(), cloud_picture(input, garment_points(input, slot), 0), "registered points");
    add_panel(rows.back(), support_picture(input, slot, 0), "outliers removed");
  }
  return figure_of("Point clouds before and after the removal of outliers", rows, "surface made no garment");
}

MadeFigure missing_points_figure(const FigureInput& input) {
  std::vector<PanelRow> rows;
  for (const char* slot : kSlots) {
    rows.push_back({{}, slot});
    for (const double azimuth : {45.0, 135.0, 225.0, 315.0})
      add_panel(rows.back(), support_picture(input, slot, azimuth), "");
  }
  return figure_of("Points from between the sensors: gaps are what none of them saw", rows, "surface made no garment");
}

MadeFigure closed_figure(const FigureInput& input) {
  return by_garment("Closed surfaces", "surface made no garment",
                    [&](const std::string& slot) { return closed_picture(input, slot, kOblique); });
}

MadeFigure captured_and_closed_figure(const FigureInput& input) {
  PanelRow row;
  const auto views = views_of_sides(input, {"front"});
  if (views.empty()) return {{}, "no registered sensor sees the front"};
  for (const char* slot : kSlots) {
    const auto& garments = input.made.closed.get().garments;
    const auto garment = garments.find(slot);
    if (garment == garments.end()) continue;
    RenderItem item;
    item.mesh = &garment->second.mesh;
    item.color = Eigen::Vector3f(0.55f, 0.66f, 0.82f);
    add_panel(row, labelled_garment(input, views.front().sensor, slot), std::string(slot) + ", captured");
    add_panel(row, seen_by(input, views.front().sensor, {item}), std::string(slot) + ", closed surface");
  }
  return figure_of("Captured clothes and their closed surfaces, by the same camera", {row}, "surface made no garment");
}

MadeFigure rough_color_figure(const FigureInput& input) {
  return by_garment("Closed surfaces in the colours of the nearest points", "surface made no garment",
                    [&](const std::string& slot) { return rough_picture(input, slot, kOblique); });
}

MadeFigure boundary_figure(const FigureInput& input) {
  return by_garment("Boundaries of the opened clothes (green)", "no garment could be opened",
                    [&](const std::string& slot) { return opened_picture(input, slot, kOblique, true); });
}

MadeFigure rim_figure(const FigureInput& input, const std::string& slot) {
  const auto& garments = input.made.opened.get().garments;
  const auto found = garments.find(slot);
  if (found == garments.end()) return {{}, "no " + slot + " could be opened"};
  const double heading = front_heading(input.made);
  const RimMarks marks = rim_marks(found->second);
  const Mesh meshes[] = {turned(found->second.mesh, heading), turned(marks.seen, heading),
                         turned(marks.unseen, heading)};
  const Eigen::Vector3f colors[] = {{0.80f, 0.82f, 0.86f}, {0.0f, 0.45f, 0.70f}, {0.90f, 0.62f, 0.0f}};
  std::vector<RenderItem> items;
  for (int i = 0; i < 3; ++i) {
    if (meshes[i].triangles.empty()) continue;
    items.emplace_back();
    items.back().mesh = &meshes[i];
    items.back().color = colors[i];
  }
  PanelRow row;
  for (const double azimuth : {kOblique, 180 + kOblique})
    add_panel(row, one_view(input.renderer, items, azimuth), azimuth < 90 ? "front" : "back");
  return figure_of("Rims of the " + slot + ": seen by a view (blue), carried on (orange)", {row}, "");
}

MadeFigure opened_figure(const FigureInput& input) {
  return by_garment("Opened clothes", "no garment could be opened",
                    [&](const std::string& slot) { return opened_picture(input, slot, kOblique, false); });
}

MadeFigure texture_map_figure(const FigureInput& input) {
  return by_garment("Texture maps", "no garment has a texture", [&](const std::string& slot) {
    const auto& garments = input.made.textured.get().garments;
    const auto found = garments.find(slot);
    return found == garments.end() ? cv::Mat() : side_by_side({found->second.texture}, kFigureHeightPx);
  });
}

MadeFigure textured_figure(const FigureInput& input, const std::string& slot) {
  PanelRow row;
  for (const auto& [azimuth, side] :
       {std::pair(0.0, "front"), std::pair(90.0, "left"), std::pair(180.0, "back"), std::pair(270.0, "right")})
    add_panel(row, textured_picture(input, slot, azimuth), side);
  return figure_of("Textured model of the " + slot, {row}, "no textured " + slot + " was made");
}

MadeFigure alignment_steps_figure(const FigureInput& input) {
  PanelRow views, result;
  for (const auto& view : run_views(input))
    add_panel(views, cloud_picture(input, naked_points(input, view.sensor), 0), view.side);
  const Mesh& body = input.made.naked.get().body;
  if (!body.triangles.empty()) add_panel(result, body_picture(input, body, front_heading(input.made), 0), "model");
  add_panel(result, cloud_picture(input, naked_points(input), 0), "registered");
  return figure_of("Registration of four views of the naked mannequin", {views, result}, "no view was registered");
}

MadeFigure surface_steps_figure(const FigureInput& input) {
  std::vector<PanelRow> rows;
  for (const char* slot : kSlots) {
    rows.push_back({{}, slot});
    for (const auto& view : run_views(input))
      add_panel(rows.back(), garment_after_filling(input, view.sensor, slot), view.side);
    rows.push_back({{}, slot});
    add_panel(rows.back(), cloud_picture(input, garment_points(input, slot), 0), "registered points");
    add_panel(rows.back(), support_picture(input, slot, 0), "outliers removed");
    add_panel(rows.back(), closed_picture(input, slot, 0), "closed surface");
  }
  return figure_of("From four views to a surface", rows, "surface made no garment");
}

MadeFigure opening_steps_figure(const FigureInput& input) {
  std::vector<PanelRow> rows;
  for (const char* slot : kSlots) {
    rows.push_back({{}, slot});
    add_panel(rows.back(), closed_picture(input, slot, kOblique), "closed surface");
    add_panel(rows.back(), rough_picture(input, slot, kOblique), "nearest colours");
    add_panel(rows.back(), opened_picture(input, slot, kOblique, true), "boundaries");
    add_panel(rows.back(), opened_picture(input, slot, kOblique, false), "opened");
  }
  return figure_of("From a closed surface to an open garment", rows, "surface made no garment");
}

MadeFigure texturing_figure(const FigureInput& input) {
  std::vector<PanelRow> rows;
  for (const char* slot : kSlots) {
    rows.push_back({{}, slot});
    add_panel(rows.back(), opened_picture(input, slot, 0, false), "surface");
    const auto& garments = input.made.textured.get().garments;
    if (const auto found = garments.find(slot); found != garments.end())
      add_panel(rows.back(), side_by_side({found->second.texture}, kFigureHeightPx), "texture map");
    add_panel(rows.back(), textured_picture(input, slot, 0), "textured");
  }
  return figure_of("Texture mapping", rows, "no garment has a texture");
}

}  // namespace dressform
