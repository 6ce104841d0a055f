#include "eval/gate/power/fault.h"

#include <algorithm>
#include <cmath>

#include "scenes/error.h"

namespace dressform {

Vector3d Placement::direction(std::uint64_t index) const {
  const auto numbers = normal4(seed_, stream_, index);
  const Vector3d vector(numbers[0], numbers[1], numbers[2]);
  return vector.norm() > 0 ? Vector3d(vector.normalized()) : Vector3d(Vector3d::UnitX());
}

std::vector<Fault> all_faults() {
  std::vector<Fault> all;
  for (const auto& part : {capture_faults(), body_faults(), view_faults(), cloth_image_faults(), garment_faults(),
                           fitted_faults(), scorer_faults()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<Fault> chosen_faults(const std::vector<std::string>& names) {
  const auto all = all_faults();
  if (names.empty()) return all;
  std::vector<Fault> chosen;
  for (const auto& name : names) {
    const auto before = chosen.size();
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen),
                 [&](const Fault& each) { return each.id() == name || each.step == name; });
    if (chosen.size() == before)
      throw InputError("--faults " + name,
                       "no such fault; expected a step or STEP.NAME as `dressform gate power --list` prints them");
  }
  return chosen;
}

std::string size_word(const Fault& fault, std::size_t k) {
  static const char* const words[] = {"small", "medium", "large"};
  return words[std::min<std::size_t>(2, k + 3 - std::min<std::size_t>(3, fault.sizes.size()))];
}

}  // namespace dressform
