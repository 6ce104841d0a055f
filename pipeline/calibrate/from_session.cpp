#include "pipeline/calibrate/calibrate.h"

namespace dressform {
namespace {

struct FromSessionParams {};
template <class V>
void fields(V&, FromSessionParams&) {}

// Takes the calibration that the session brings along.
Calibrated from_session(const CaptureSession& session, const FromSessionParams&) {
  if (!session.calibration)
    throw InputError("calibration.json", "the session has none; expected one for the variant calibrate.from_session");
  return {*session.calibration, {}, {}};
}

const Calibrate::Variant from_session_variant{"from_session", from_session};

}  // namespace
}  // namespace dressform
