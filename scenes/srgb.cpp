#include "scenes/srgb.h"

#include <algorithm>

namespace dressform {

float linear_from_srgb(float value) { return linear_of_srgb(std::clamp(value, 0.0f, 1.0f)); }

float srgb_from_linear(float value) { return srgb_of_linear(std::clamp(value, 0.0f, 1.0f)); }

}  // namespace dressform
