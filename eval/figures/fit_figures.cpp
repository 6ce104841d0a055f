#include "eval/figures/fit_figures.h"

#include "eval/figures/run_views.h"
#include "eval/figures/shape_pictures.h"
#include "eval/report/stage_images.h"
#include "eval/report/turned.h"

namespace dressform {
namespace {

constexpr const char* kNoUser = "the session has no scan of the user";
using WornGarments = std::map<std::string, TexturedMesh>;

double heading_of_front(const Landmarks& landmarks) { return std::atan2(landmarks.front.x(), landmarks.front.z()); }

// A body in its clothes, already turned; keeps what the items of a picture point into.
class Wearer {
 public:
  Wearer(const Mesh& body, const WornGarments& garments, double heading) : body_(turned(body, heading)) {
    for (const auto& [slot, garment] : garments) garments_.push_back(turned(garment, heading));
  }
  std::vector<RenderItem> items() const {
    std::vector<RenderItem> all(1);
    all[0].mesh = &body_;
    all[0].color = kBodyColor;
    for (const auto& garment : garments_) {
      all.emplace_back();
      all.back().textured = &garment;
      all.back().shading = Shading::textured;
    }
    return all;
  }

 private:
  Mesh body_;
  std::vector<TexturedMesh> garments_;
};

cv::Mat worn_picture(const FigureInput& input, const Mesh& body, const WornGarments& garments, double heading,
                     double azimuth_deg) {
  if (body.triangles.empty()) return {};
  return one_view(input.renderer, Wearer(body, garments, heading).items(), azimuth_deg);
}

double degrees_of(const std::string& side) {
  return side == "front" ? 0 : side == "left" ? 90 : side == "back" ? 180 : 270;
}

}  // namespace

MadeFigure user_figure(const FigureInput& input) {
  if (!input.made.user) return {{}, kNoUser};
  const BodyModel& user = input.made.user->get();
  if (user.body.triangles.empty()) return {{}, "fuse made no body of the user's scan"};
  PanelRow row;
  for (const auto& [azimuth, side] : {std::pair(0.0, "front"), std::pair(90.0, "left"), std::pair(180.0, "back")})
    row.panels.push_back({body_picture(input, user.body, scan_heading(user), azimuth), side});
  return {PanelFigure{"Model of the user from the scan", {row}, {}, true}, ""};
}

MadeFigure two_bodies_figure(const FigureInput& input) {
  if (!input.made.user || !input.made.user_landmarks) return {{}, kNoUser};
  const Mesh naked = turned(input.made.naked.get().body, heading_of_front(input.made.landmarks.get()));
  const Mesh user = turned(input.made.user->get().body, heading_of_front(input.made.user_landmarks->get()));
  if (naked.triangles.empty() || user.triangles.empty()) return {{}, "one of the two bodies is missing"};
  std::vector<RenderItem> items(2);
  items[0].mesh = &naked, items[0].color = kBodyColor;
  items[1].mesh = &user, items[1].color = Eigen::Vector3f(0.0f, 0.45f, 0.70f), items[1].opacity = 0.5f;
  PanelRow row{{{one_view(input.renderer, items, 0), "front"}, {one_view(input.renderer, items, 90), "left"}}, ""};
  return {
      PanelFigure{
          "Mannequin (beige) and user (blue) as fit compares them: feet on one floor, facing alike", {row}, {}, true},
      ""};
}

MadeFigure deformed_body_figure(const FigureInput& input) {
  if (!input.made.fitted) return {{}, kNoUser};
  const double here = heading_of_front(input.made.landmarks.get());
  const double there = heading_of_front(input.made.user_landmarks->get());
  const Mesh& deformed = input.made.fitted->get().deformed_body;
  if (deformed.triangles.empty()) return {{}, "this variant of fit moves the clothes without deforming the body"};
  std::vector<PanelRow> rows;
  for (const double azimuth : {0.0, 90.0})
    rows.push_back({{{body_picture(input, input.made.naked.get().body, here, azimuth), "mannequin"},
                     {body_picture(input, input.made.user->get().body, there, azimuth), "user"},
                     {body_picture(input, deformed, there, azimuth), "mannequin, deformed"}},
                    azimuth == 0 ? "front" : "left"});
  return {PanelFigure{"Deforming the mannequin to the user's size and shape", rows, {}, true}, ""};
}

MadeFigure resized_figure(const FigureInput& input) {
  if (!input.made.corrected) return {{}, kNoUser};
  const double here = front_heading(input.made), there = heading_of_front(input.made.user_landmarks->get());
  const Mesh& user = input.made.user->get().body;
  std::vector<PanelRow> rows;
  for (const double azimuth : {0.0, 180.0}) {
    const auto on_user = [&](const WornGarments& garments) {
      return worn_picture(input, user, garments, there, azimuth);
    };
    rows.push_back(
        {{{worn_picture(input, input.made.naked.get().body, input.made.textured.get().garments, here, azimuth),
           "mannequin"},
          {on_user(input.made.fitted->get().garments), "user, before correction"},
          {on_user(input.made.corrected->get().garments), "user, corrected"}},
         azimuth == 0 ? "front" : "back"});
  }
  return {PanelFigure{"Clothes resized to the user", rows, {}, true}, ""};
}

MadeFigure compared_figure(const FigureInput& input) {
  std::vector<PanelRow> rows;
  for (const auto& view : run_views(input)) {
    const Wearer wearer(input.made.naked.get().body, input.made.textured.get().garments, 0);  // in the model's frame
    PanelRow row{{}, view.side};
    const auto add = [&](const cv::Mat& picture, const std::string& label) {
      if (!picture.empty()) row.panels.push_back({picture, label});
    };
    add(dressed_picture(input, view.sensor), "captured");
    add(seen_by(input, view.sensor, wearer.items()), "reconstructed");
    if (input.made.corrected)
      add(worn_picture(input, input.made.user->get().body, input.made.corrected->get().garments,
                       heading_of_front(input.made.user_landmarks->get()), degrees_of(view.side)),
          "on the user");
    rows.push_back(row);
  }
  if (rows.empty()) return {{}, "no view was registered"};
  return {PanelFigure{"Captured clothes, reconstructed and resized", rows, {}, true}, ""};
}

}  // namespace dressform
