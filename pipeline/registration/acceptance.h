#pragma once
#include <string>
#include <vector>

#include "pipeline/registration/model_alignment.h"

namespace dressform {

// What makes a view's pose believable.
struct AcceptanceOptions {
  double least_inlier_part = 0.5;          // of the mannequin's points
  double largest_residual_m = 0.008;       // RMS of the inliers
  double largest_contradicted_part = 0.3;  // of the model's visible surface that the sensor looked through
  double largest_looked_through_part = 0.3;
  double largest_floor_tilt_deg = 1.5;  // 10 mm of a depth camera's own error over a metre of floor tilt it by .6
  double largest_floor_height_m = 0.1;
  double largest_residual_over_noise = 5;
  double largest_rotation_sigma_deg = 2, largest_translation_sigma_m = 0.025;
};

template <class V>
void acceptance_fields(V& v, AcceptanceOptions& p) {
  v("least_inlier_part", p.least_inlier_part, 0.0, 1.0, "", "of the mannequin's points, for a view to be registered");
  v("largest_residual_m", p.largest_residual_m, 0.001, 0.1, "m", "RMS of the inliers, for a view to be registered");
  v("largest_contradicted_part", p.largest_contradicted_part, 0.0, 1.0, "",
    "of the model's surface that the sensor looked through, for a view to be registered");
  v("largest_looked_through_part", p.largest_looked_through_part, 0.0, 1.0, "",
    "of a view's mannequin that another view looked through, for the view to be registered");
  v("largest_floor_tilt_deg", p.largest_floor_tilt_deg, 0.1, 90.0, "deg",
    "between a view's floor and the model's, for the view to be registered");
  v("largest_floor_height_m", p.largest_floor_height_m, 0.001, 1.0, "m",
    "between a view's floor and the model's under the mannequin, for the view to be registered");
  v("largest_residual_over_noise", p.largest_residual_over_noise, 1.0, 100.0, "",
    "RMS of the inliers over what noise explains, for a view to be registered");
  v("largest_rotation_sigma_deg", p.largest_rotation_sigma_deg, 0.01, 90.0, "deg",
    "of a pose, by leaving parts of the body out, for a view to be registered");
  v("largest_translation_sigma_m", p.largest_translation_sigma_m, 0.0005, 1.0, "m",
    "of a pose at the body's centre, by leaving parts of the body out, for a view to be registered");
}

bool acceptable(const ViewPoints& view, const ModelTarget& target, const ViewAlignment& alignment,
                const AcceptanceOptions& options);

// Takes back views whose residual is out of line with the others': more than twice the median of at least three. Such a
// view shows something else of much the same shape.
void reject_outliers(const std::vector<ViewAlignment>& alignments, std::vector<char>& accepted);

// How the views came out: evidence of those that had a pose to judge, and why others have none.
struct ViewVerdicts {
  std::vector<char> accepted;
  std::vector<PoseEvidence> evidence;
  std::vector<std::string> problems;  // empty: none
};

inline ViewVerdicts no_verdicts(std::size_t views) {
  return {std::vector<char>(views, 0), std::vector<PoseEvidence>(views), std::vector<std::string>(views)};
}

// Judges the accepted views by what did not make their poses (evidence.h) and takes back the one that fails worst.
// Whether one was taken back: the others may come out differently without it.
bool reject_by_evidence(const std::vector<ViewPoints>& views, const ModelTarget& target,
                        const std::vector<ViewAlignment>& alignments, const AcceptanceOptions& options,
                        ViewVerdicts& verdicts);

// The stage's result: a pose for every accepted view, an entry without pose for every other sensor of the session.
Registration registration_of(const std::vector<ViewPoints>& views, const std::vector<ViewAlignment>& alignments,
                             const ViewVerdicts& verdicts);

// Throws InputError when the model has no surface or the session no sensors.
void check_registration_input(const CaptureSession& session, const BodyModel& naked);

}  // namespace dressform
