#pragma once
#include "eval/inspect/inspect_sensor.h"
#include "scenes/capture_session.h"

namespace dressform {

// What is in a capture session: images of every stream, the points of the sensors where the rig's prior puts them,
// and how noisy depth is beside what is published of such sensors. Truth is not looked at.
Inspection inspect_session(const CaptureSession& session, const InspectionProgress& progress);

}  // namespace dressform
