#pragma once
#include "scenes/toml_section.h"

namespace dressform {

// A calibration as a person writes it (scenes/README.md): `model`, `depth_offset_m`, the cameras `ir` (needed) and
// `color` with width, height, fx, fy, cx, cy, distortion, and the step `color_from_ir`. Throws InputError naming file,
// line and column.
SensorCalibration read_calibration(TomlSection& section);

// Three rows of three as `rotation`, `translation_m`.
Isometry3d read_step(TomlSection& section);

}  // namespace dressform
