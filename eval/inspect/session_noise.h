#pragma once
#include "eval/inspect/inspection.h"
#include "scenes/capture_session.h"

namespace dressform {

// How noisy the depth of a session is, by sensor model: on smooth surfaces from pixel to pixel and, where a view was
// taken more than once, from frame to frame; what edges do; which depths occur. Beside published curves, unjudged: the
// scene's own roughness and albedo are in it.
std::vector<InspectionSection> noise_sections(const CaptureSession& session);

}  // namespace dressform
