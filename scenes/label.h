#pragma once
#include <cstdint>

namespace dressform {

// What a label image says of a pixel.
enum class Label : std::uint8_t { none = 0, skin = 1, top = 2, bottom = 3 };

}  // namespace dressform
