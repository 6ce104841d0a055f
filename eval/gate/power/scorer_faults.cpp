// Faults in the scorer and in the pictures: what judges has to be judged as well.
#include <cmath>
#include <opencv2/core.hpp>

#include "eval/gate/power/fault.h"
#include "eval/gate/power/fault_shapes.h"

namespace dressform {
namespace {

Fault scorer_fault(const std::string& name, const std::string& unit, std::vector<double> sizes, const std::string& what,
                   void (*edit)(ScorerInput&, double, const Placement&)) {
  Fault fault{"scores", name, unit, std::move(sizes), what, {}, {}, {}, {}, {}};
  fault.on_scorer = edit;
  return fault;
}
Fault score_fault(const std::string& name, const std::string& unit, std::vector<double> sizes, const std::string& what,
                  void (*edit)(Scores&, double, const Placement&)) {
  Fault fault{"scores", name, unit, std::move(sizes), what, {}, {}, {}, {}, {}};
  fault.on_scores = edit;
  return fault;
}
Fault image_fault(const std::string& name, const std::string& unit, std::vector<double> sizes, const std::string& what,
                  void (*edit)(cv::Mat&, double, const Placement&)) {
  Fault fault{"image", name, unit, std::move(sizes), what, {}, {}, {}, {}, {}};
  fault.on_image = edit;
  return fault;
}

void move_truth(ScorerInput& input, double size_mm, const Placement& place) {
  for (auto& [slot, garment] : input.truth.garments) {
    shift(garment.mesh, size_mm / 1000 * place.direction(1));
    shift(garment.textured.mesh, size_mm / 1000 * place.direction(1));
  }
}
void turn_gauge(ScorerInput& input, double size_deg, const Placement& place) {
  if (!input.truth.world_from_sensor.empty())
    input.truth.world_from_sensor.begin()->second.rotate(Eigen::AngleAxisd(size_deg * M_PI / 180, place.direction(1)));
}
void shift_true_labels(ScorerInput& input, double size_px, const Placement&) {
  for (auto& [sensor, labels] : input.truth.labels) shift_image(labels, static_cast<int>(size_px), 0);
}
void coarsen_points(ScorerInput& input, double size_times, const Placement&) {
  input.options.sample_spacing_m *= size_times;
}

// Rows of one unit off by a factor: metres taken for something else, a diameter for a radius.
void stretch_lengths(Scores& scores, double size_percent, const Placement&) {
  for (auto& row : scores.rows)
    if (row.unit == "mm") row.value *= 1 + size_percent / 100;
}
void lower_ratios(Scores& scores, double size_percent, const Placement&) {
  for (auto& row : scores.rows)
    if (row.unit == "1") row.value *= 1 - size_percent / 100;
}
void lose_rows(Scores& scores, double size_count, const Placement& place) {
  for (int k = 0; k < static_cast<int>(size_count) && !scores.rows.empty(); ++k)
    scores.rows.erase(scores.rows.begin() +
                      static_cast<std::ptrdiff_t>(place.uniform(k) * static_cast<double>(scores.rows.size())));
}

void hole_in_image(cv::Mat& image, double size_px, const Placement& place) {
  square_hole(image, static_cast<int>(size_px), cv::Scalar(90, 60, 200), place);  // a colour that no scene has
}
void shift_picture(cv::Mat& image, double size_px, const Placement&) {
  shift_image(image, static_cast<int>(size_px), 0);
}
void darken_picture(cv::Mat& image, double size_levels, const Placement&) { add_levels(image, -size_levels); }
void blur_picture(cv::Mat& image, double size_px, const Placement&) { blur_image(image, size_px); }

}  // namespace

std::vector<Fault> scorer_faults() {
  return {
      scorer_fault("truth_moved", "mm", {1, 4, 12}, "true garments elsewhere", move_truth),
      scorer_fault("gauge_turned", "deg", {0.05, 0.3, 1.5}, "the first sensor's true pose turned", turn_gauge),
      scorer_fault("labels_shifted", "px", {1, 4, 12}, "true labels to the right", shift_true_labels),
      scorer_fault("points_coarse", "times", {2, 6, 20}, "points on surfaces further apart", coarsen_points),
      score_fault("lengths_long", "%", {2, 10, 50}, "all rows in mm too large", stretch_lengths),
      score_fault("ratios_low", "%", {0.5, 2, 10}, "all ratios too small", lower_ratios),
      score_fault("rows_lost", "count", {1, 3, 10}, "rows no longer measured", lose_rows),
      image_fault("hole", "px", {4, 8, 24}, "a square of another colour in the pictures", hole_in_image),
      image_fault("shifted", "px", {1, 2, 6}, "pictures to the right", shift_picture),
      image_fault("darkened", "levels", {1, 3, 10}, "pictures darker", darken_picture),
      image_fault("blurred", "px", {0.4, 1, 3}, "pictures out of focus", blur_picture),
  };
}

}  // namespace dressform
