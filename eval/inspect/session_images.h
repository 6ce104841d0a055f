#pragma once
#include "eval/inspect/inspection.h"
#include "scenes/capture_session.h"

namespace dressform {

// Contact sheets of every stream of a session: colour, depth with a colour bar, infrared and body index of the shots, a
// dozen frames of each scan, half a dozen shots of the boards of each sensor.
std::vector<InspectionSection> stream_sections(const CaptureSession& session);

}  // namespace dressform
