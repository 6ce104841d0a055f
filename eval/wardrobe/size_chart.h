#pragma once
#include <string>
#include <vector>

namespace dressform {

// A class of bodies that clothes are made for, metres: the range of the chest (men) or bust (women) that its letter
// stands for, and the girths of the body in its middle.
struct SizeClass {
  std::string name;  // "XS" to "XXL"
  double chest_low_m = 0, chest_high_m = 0;
  double chest_m = 0, waist_m = 0, hip_m = 0;
};

// The letter codes XS to XXL of EN 13402-3 for "men" or "women". Ranges of chest and bust are the standard's; so is the
// drop from there to the waist (12 cm and 16 cm) and women's hips; men's hips, which the standard leaves open, follow
// the waist as in the survey ANSUR II. Throws InputError for another word.
std::vector<SizeClass> size_chart(const std::string& sex);

// The class whose range of the chest holds a girth; the nearest one outside all.
const SizeClass& class_of_chest(const std::vector<SizeClass>& chart, double chest_m);

}  // namespace dressform
