#pragma once
#include <string>

namespace dressform {

// A round step (1, 2 or 5 times a power of ten) that divides the range into at most `most` parts.
double round_step(double range, int most);

// A value at a tick, with as many decimals as the step between ticks asks for.
std::string tick_text(double value, double step);

}  // namespace dressform
