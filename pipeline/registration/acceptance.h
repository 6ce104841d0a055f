#pragma once
#include "pipeline/registration/model_alignment.h"

namespace dressform {

// What makes a view's pose believable.
struct AcceptanceOptions {
  double least_inlier_part = 0.5;          // of the mannequin's points
  double largest_residual_m = 0.008;       // RMS of the inliers
  double largest_contradicted_part = 0.3;  // of the model's visible surface that the sensor looked through
};

template <class V>
void acceptance_fields(V& v, AcceptanceOptions& p) {
  v("least_inlier_part", p.least_inlier_part, 0.0, 1.0, "", "of the mannequin's points, for a view to be registered");
  v("largest_residual_m", p.largest_residual_m, 0.001, 0.1, "m", "RMS of the inliers, for a view to be registered");
  v("largest_contradicted_part", p.largest_contradicted_part, 0.0, 1.0, "",
    "of the model's surface that the sensor looked through, for a view to be registered");
}

bool acceptable(const ViewPoints& view, const ModelTarget& target, const ViewAlignment& alignment,
                const AcceptanceOptions& options);

// Takes back views whose residual is out of line with the others': more than twice the median of at least three. Such a
// view shows something else of much the same shape.
void reject_outliers(const std::vector<ViewAlignment>& alignments, std::vector<char>& accepted);

// The stage's result: a pose for every accepted view, an entry without pose for every other sensor of the session.
Registration registration_of(const std::vector<ViewPoints>& views, const std::vector<ViewAlignment>& alignments,
                             const std::vector<char>& accepted);

// Throws InputError when the model has no surface or the session no sensors.
void check_registration_input(const CaptureSession& session, const BodyModel& naked);

}  // namespace dressform
