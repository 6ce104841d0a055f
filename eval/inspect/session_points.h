#pragma once
#include "eval/inspect/inspection.h"
#include "render/renderer.h"
#include "scenes/capture_session.h"

namespace dressform {

// The points of the sensors where the rig's prior puts them, from several sides, in one colour a sensor and in the
// colours seen; where there is no prior, each sensor's by themselves.
InspectionSection points_section(const CaptureSession& session, Renderer& renderer);

}  // namespace dressform
