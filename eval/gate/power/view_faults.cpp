// Faults in the cut-out views and in where the sensors stand.
#include <cmath>

#include "eval/gate/power/fault.h"
#include "eval/gate/power/fault_shapes.h"
#include "pipeline/extract/extract.h"
#include "pipeline/registration/registration.h"

namespace dressform {
namespace {

void grow_view(ExtractedViews& extracted, int pixels, const Placement& place) {
  const auto found = extracted.views.find(place.one_of(extracted.views));
  if (found == extracted.views.end()) return;
  for (cv::Mat* mask :
       {&found->second.naked, &found->second.dressed, &found->second.naked_color, &found->second.dressed_color})
    grow_mask(*mask, pixels);
}
void erode_view(ExtractedViews& extracted, double size_px, const Placement& place) {
  grow_view(extracted, -static_cast<int>(size_px), place);
}
void dilate_view(ExtractedViews& extracted, double size_px, const Placement& place) {
  grow_view(extracted, static_cast<int>(size_px), place);
}

void lose_masks(ExtractedViews& extracted, double size_count, const Placement& place) {
  auto left = extracted.views;
  for (int k = 0; k < static_cast<int>(size_count) && !left.empty(); ++k) {
    const std::string sensor = place.one_of(left, k);
    ViewMasks& view = extracted.views.at(sensor);
    for (cv::Mat* mask : {&view.naked, &view.dressed, &view.naked_color, &view.dressed_color}) mask->setTo(0);
    view.found_naked = view.found_dressed = false;
    left.erase(sensor);
  }
}

void move_view(Registration& registration, double size_mm, const Placement& place) {
  const auto found = registration.model_from_sensor.find(place.one_of(registration.model_from_sensor));
  if (found != registration.model_from_sensor.end()) found->second.pretranslate(size_mm / 1000 * place.direction(1));
}

// About the view's own centre: what it sees 2 m away moves by 35 mm a degree.
void turn_view(Registration& registration, double size_deg, const Placement& place) {
  const auto found = registration.model_from_sensor.find(place.one_of(registration.model_from_sensor));
  if (found != registration.model_from_sensor.end())
    found->second.rotate(Eigen::AngleAxisd(size_deg * M_PI / 180, place.direction(1)));
}

// All views together, about the model's upright axis: as if front were elsewhere on the body.
void turn_rig(Registration& registration, double size_deg, const Placement&) {
  for (auto& [sensor, pose] : registration.model_from_sensor)
    pose.prerotate(Eigen::AngleAxisd(size_deg * M_PI / 180, Vector3d::UnitY()));
}

void lose_views(Registration& registration, double size_count, const Placement& place) {
  for (int k = 0; k < static_cast<int>(size_count) && !registration.model_from_sensor.empty(); ++k) {
    const std::string sensor = place.one_of(registration.model_from_sensor, k);
    registration.model_from_sensor.erase(sensor);
    registration.converged[sensor] = false;
    registration.problem[sensor] = "was taken away";
  }
}

void swap_views(Registration& registration, double, const Placement&) {
  if (registration.model_from_sensor.size() < 2) return;
  std::swap(registration.model_from_sensor.begin()->second, std::next(registration.model_from_sensor.begin())->second);
}

}  // namespace

std::vector<Fault> view_faults() {
  return {
      artifact_fault<ExtractedViews>("extract", "eroded", "px", {2, 6, 20}, "masks of one view too small", erode_view),
      artifact_fault<ExtractedViews>("extract", "dilated", "px", {2, 6, 20}, "masks of one view too large",
                                     dilate_view),
      artifact_fault<ExtractedViews>("extract", "lost", "count", {1, 2, 3}, "views without masks", lose_masks),
      artifact_fault<Registration>("registration", "view_moved", "mm", {1, 5, 20}, "one view moved", move_view),
      artifact_fault<Registration>("registration", "view_turned", "deg", {0.05, 0.3, 1.5}, "one view turned",
                                   turn_view),
      artifact_fault<Registration>("registration", "rig_turned", "deg", {0.3, 1.5, 8},
                                   "all views turned about the body", turn_rig),
      artifact_fault<Registration>("registration", "views_lost", "count", {1, 2, 3}, "views not registered",
                                   lose_views),
      artifact_fault<Registration>("registration", "views_swapped", "there", {1}, "the first two views exchanged",
                                   swap_views),
  };
}

}  // namespace dressform
