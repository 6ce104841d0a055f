#pragma once
#include <functional>

#include "pipeline/registration/acceptance.h"
#include "pipeline/registration/initial_poses.h"

namespace dressform {

// Of the variants that bring every view to the model by itself.
struct EachViewOptions {
  int points = 0;      // of the mannequin used in every view
  int iterations = 0;  // at each of three widths of the loss
  LossWidths loss = {};
  InitialPoseOptions initial = {};
  AcceptanceOptions acceptance = {};
};

template <class V>
void each_view_fields(V& v, EachViewOptions& p, int most_iterations) {
  v("points", p.points, 200, 200000, "", "of the mannequin used in every view");
  v("iterations", p.iterations, 1, most_iterations, "", "at each of three widths of the loss");
  loss_fields(v, p.loss);
  v("headings", p.initial.headings, 4, 360, "", "starts round the circle");
  v("prior_reach_deg", p.initial.prior_reach_deg, 5.0, 180.0, "deg", "how far a view may turn from the rig prior");
  acceptance_fields(v, p.acceptance);
}

// How one view is brought to the model: from a pose near it, model_from_sensor, with a loss that narrows from gate to
// gate. Called from several threads, for different views.
using AlignView = std::function<ViewAlignment(const ViewPoints&, const ModelTarget&, const Isometry3d& initial,
                                              const std::vector<ModelGate>&, int iterations)>;

// Initial poses, every view by itself, and the views that nothing speaks against. Throws as check_registration_input.
Registration register_each_view(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                                const ExtractedViews& extracted, const EachViewOptions& options,
                                const AlignView& align);

}  // namespace dressform
