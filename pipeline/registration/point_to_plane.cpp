#include "pipeline/registration/each_view.h"

namespace dressform {
namespace {

struct PointToPlaneParams {
  EachViewOptions views{6000, 20};
};

template <class V>
void fields(V& v, PointToPlaneParams& p) {
  each_view_fields(v, p.views, 200);
}

// Every view by itself against the model (Chen and Medioni, ICRA 1991), with a loss that narrows.
Registration point_to_plane(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                            const ExtractedViews& extracted, const PointToPlaneParams& params) {
  return register_each_view(session, calibration, naked, extracted, params.views, align_to_model);
}

const Register::Variant point_to_plane_variant{"point_to_plane", point_to_plane};

}  // namespace
}  // namespace dressform
