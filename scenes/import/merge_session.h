#pragma once
#include "scenes/import/import.h"

namespace dressform {

// Outline (its images are empty) of the session of `request.with`, where there is one, with the recording in it. Notes
// say what the session then still lacks. Throws InputError where the two do not go together: the place is taken,
// another calibration of the same sensor is known, boards are of another kind, or the format does not allow it.
CaptureSession merged_session(const ImportRequest& request, const std::optional<SensorCalibration>& calibration,
                              int frames, std::vector<std::string>& notes);

// Copies all images of a session, not its truth, into the folder of another one.
void copy_images(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace dressform
