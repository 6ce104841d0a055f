#pragma once
#include <array>
#include <string>
#include <vector>

#include "scenes/error.h"

namespace dressform {

// Units of length in which numbers may be meant.
struct LengthUnit {
  const char *name, *plural;  // "mm", "millimetres"
  double metres;
};
inline constexpr std::array<LengthUnit, 6> kLengthUnits{{{"m", "metres", 1},
                                                         {"dm", "decimetres", 0.1},
                                                         {"cm", "centimetres", 0.01},
                                                         {"mm", "millimetres", 0.001},
                                                         {"inch", "inches", 0.0254},
                                                         {"foot", "feet", 0.3048}}};

inline std::vector<std::string> length_unit_names() {
  std::vector<std::string> names;
  for (const LengthUnit& unit : kLengthUnits) names.push_back(unit.name);
  return names;
}

// The unit of that name. Throws InputError naming the field "unit" with the names that are known.
inline const LengthUnit& length_unit(const std::string& name) {
  std::string known;
  for (const LengthUnit& unit : kLengthUnits) {
    if (name == unit.name) return unit;
    known += (known.empty() ? "" : ", ") + std::string(unit.name);
  }
  throw InputError("unit", "found \"" + name + "\"; expected one of " + known);
}

// Metres in one unit of that name; throws as length_unit does.
inline double metres_in(const std::string& name) { return length_unit(name).metres; }

}  // namespace dressform
