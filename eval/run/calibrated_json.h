#pragma once
#include <string>

#include "pipeline/calibrate/calibrate.h"

namespace dressform {

// calibration.json of a session (scenes/README.md), with two more members: `boards`, what the boards gave for each
// sensor that was calibrated from them, and `notes` by sensor. Same values, same bytes.
std::string calibrated_json(const Calibrated& calibrated);

}  // namespace dressform
