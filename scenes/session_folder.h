#pragma once
#include "scenes/capture_session.h"
#include "scenes/new_folder.h"

namespace dressform {

// Writes session.json, calibration.json and the poses of scans, whose folders are there, and gives the folder its name:
// for writers that do not hold all images of a session at once and have put them there before. Of the images in
// `outline` only the number counts.
void finish_session(NewFolder& folder, const CaptureSession& outline);

}  // namespace dressform
