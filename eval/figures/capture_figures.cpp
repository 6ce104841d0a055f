#include "eval/figures/capture_figures.h"

#include <opencv2/imgproc.hpp>

#include "eval/figures/run_views.h"
#include "eval/report/image_tools.h"
#include "eval/report/jseg_images.h"

namespace dressform {
namespace {

const std::vector<std::string> kAllSides{"front", "left", "back", "right"};

std::string word_of(const std::string& slot) { return slot == "top" ? "shirt" : "bottom"; }

// One panel a view; the reason where there is none at all.
template <class Paint>
MadeFigure one_row(const FigureInput& input, const std::vector<std::string>& sides, const std::string& title,
                   const std::string& reason, const Paint& paint) {
  PanelRow row;
  for (const auto& view : views_of_sides(input, sides))
    if (const cv::Mat picture = paint(view.sensor); !picture.empty()) row.panels.push_back({picture, view.side});
  if (row.panels.empty()) return {{}, reason};
  return {PanelFigure{title, {row}, {}, true}, ""};
}

cv::Mat extracted_picture(const FigureInput& input, const std::string& sensor) {
  const auto& views = input.made.extracted.get().views;
  const auto found = views.find(sensor);
  return found == views.end() || !found->second.found_dressed ? cv::Mat()
                                                              : cut_out(input, sensor, found->second.dressed_color);
}

// The tracked joints of the sensor's skeleton on the dressed shot. Empty where none was recorded.
cv::Mat skeleton_picture(const FigureInput& input, const std::string& sensor) {
  const auto shot = input.session.dressed.find(sensor);
  const auto& calibration = input.made.calibration.get().sensors.at(sensor);
  if (shot == input.session.dressed.end() || !shot->second.skeleton || shot->second.color.empty() || !calibration.color)
    return {};
  cv::Mat image = shot->second.color.clone();
  const int radius = std::max(2, image.rows / 120);
  for (const auto& [name, joint] : *shot->second.skeleton) {
    const Vector3d point = calibration.color_from_ir * joint.position;
    if (!joint.tracked || point.z() <= 0) continue;
    const Vector2d pixel = calibration.color->project(point);
    cv::circle(image, cv::Point2d(pixel.x(), pixel.y()), radius, cv::Scalar(60, 220, 60), cv::FILLED, cv::LINE_AA);
  }
  const auto masks = input.made.extracted.get().views.find(sensor);
  return masks == input.made.extracted.get().views.end() ? image
                                                         : image(box_around(masks->second.dressed_color, 0.06)).clone();
}

}  // namespace

MadeFigure board_figure(const FigureInput& input) {
  if (!input.session.boards) return {{}, "the session has no shots of a checkerboard"};
  for (const auto& [sensor, shots] : input.session.boards->shots)
    for (const auto& shot : shots)
      if (!shot.color.empty() && !shot.ir.empty())
        return {PanelFigure{"Checkerboard by the two cameras of " + sensor,
                            {{{{shot.color, "colour"}, {infrared_image(shot.ir), "infrared"}}, ""}},
                            {},
                            true},
                ""};
  return {{}, "no shot of the checkerboard has both a colour and an infrared image"};
}

MadeFigure extraction_figure(const FigureInput& input, const std::vector<std::string>& sides) {
  PanelRow row;
  for (const auto& view : views_of_sides(input, sides)) {
    const cv::Mat extracted = extracted_picture(input, view.sensor);
    if (extracted.empty()) continue;
    if (const cv::Mat skeleton = skeleton_picture(input, view.sensor); !skeleton.empty())
      row.panels.push_back({skeleton, view.side + ", joints"});
    row.panels.push_back({dressed_picture(input, view.sensor), view.side});
    row.panels.push_back({extracted, view.side + ", extracted"});
  }
  if (row.panels.empty()) return {{}, "the mannequin was found in none of these views"};
  return {PanelFigure{"Dressed mannequin extracted from the room", {row}, {}, true}, ""};
}

MadeFigure region_figure(const FigureInput& input) {
  return one_row(input, kAllSides, "Regions of even colour and texture (JSEG), borders in red",
                 "the mannequin was found in no view", [&](const std::string& sensor) {
                   const cv::Mat picture = extracted_picture(input, sensor);
                   if (picture.empty()) return cv::Mat();
                   return border_overlay(picture, jseg(picture, {}, {}).regions);
                 });
}

MadeFigure labelled_figure(const FigureInput& input, const std::string& slot) {
  return one_row(input, kAllSides, "Extracted " + word_of(slot), "segment found no " + slot,
                 [&](const std::string& sensor) { return labelled_garment(input, sensor, slot); });
}

MadeFigure armpit_figure(const FigureInput& input) {
  const auto views = views_of_sides(input, {"front"});
  const cv::Mat shirt = views.empty() ? cv::Mat() : labelled_garment(input, views.front().sensor, "top");
  if (shirt.empty()) return {{}, "no top was found in a front view"};
  cv::Mat grey, inside;
  cv::cvtColor(shirt, grey, cv::COLOR_BGR2GRAY);
  inside = grey < 255;
  const cv::Rect box = cv::boundingRect(inside);
  // An armpit lies about a quarter down a shirt and a quarter in from its side.
  const cv::Rect zoom = cv::Rect(box.x + box.width / 10, box.y + box.height / 8, std::max(8, 3 * box.width / 10),
                                 std::max(8, 3 * box.height / 10)) &
                        cv::Rect(0, 0, shirt.cols, shirt.rows);
  cv::Mat marked = shirt.clone();
  cv::rectangle(marked, zoom, cv::Scalar(0, 94, 213), std::max(1, shirt.rows / 200));
  return {PanelFigure{"Extracted shirt and zoom at the armpit",
                      {{{{marked, "front"}, {shirt(zoom).clone(), "zoom"}}, ""}},
                      {},
                      true},
          ""};
}

MadeFigure cleaned_figure(const FigureInput& input, const std::string& slot) {
  return one_row(input, kAllSides, "Pixels of the " + word_of(slot) + " that later stages take", "fill has no " + slot,
                 [&](const std::string& sensor) { return garment_before_filling(input, sensor, slot); });
}

MadeFigure filling_figure(const FigureInput& input, const std::string& slot) {
  PanelRow row;
  for (const auto& view : views_of_sides(input, {"left", "right"})) {
    const cv::Mat before = garment_before_filling(input, view.sensor, slot);
    if (before.empty()) continue;
    row.panels.push_back({before, view.side + ", before"});
    row.panels.push_back({garment_after_filling(input, view.sensor, slot), view.side + ", filled"});
  }
  if (row.panels.empty()) return {{}, "no left or right view shows a " + slot};
  return {PanelFigure{"Region filling of the " + word_of(slot), {row}, {}, true}, ""};
}

MadeFigure view_extraction_figure(const FigureInput& input, const std::string& side) {
  const auto views = views_of_sides(input, {side});
  if (views.empty()) return {{}, "no registered sensor sees the " + side};
  const std::string& sensor = views.front().sensor;
  PanelRow cameras, garments;
  const auto add = [](PanelRow& row, const cv::Mat& picture, const std::string& label) {
    if (!picture.empty()) row.panels.push_back({picture, label});
  };
  add(cameras, dressed_picture(input, sensor), "colour image");
  add(cameras, extracted_picture(input, sensor), "mannequin");
  for (const char* slot : {"top", "bottom"}) add(cameras, labelled_garment(input, sensor, slot), word_of(slot));
  for (const char* slot : {"top", "bottom"})
    add(garments, garment_before_filling(input, sensor, slot), word_of(slot) + ", cleaned");
  if (side == "left" || side == "right")
    for (const char* slot : {"top", "bottom"})
      add(garments, garment_after_filling(input, sensor, slot), word_of(slot) + ", filled");
  if (cameras.panels.empty()) return {{}, "the mannequin was not found in the " + side + " view"};
  return {PanelFigure{"Clothes extraction, " + side + " view", {cameras, garments}, {}, true}, ""};
}

}  // namespace dressform
