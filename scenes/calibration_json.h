#pragma once
#include "scenes/camera.h"
#include "scenes/json_file.h"

namespace dressform {

// calibration.json of a capture session and of its truth.
Calibration read_calibration(const std::filesystem::path& file);
nlohmann::ordered_json calibration_json(const Calibration& calibration);
void write_calibration(const std::filesystem::path& file, const Calibration& calibration);

}  // namespace dressform
