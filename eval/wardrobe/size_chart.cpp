#include "eval/wardrobe/size_chart.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenes/error.h"

namespace dressform {
namespace {

struct Range {
  const char* name;
  double low_cm, high_cm;
};
constexpr Range kMensChest[] = {{"XS", 78, 86},  {"S", 86, 94},    {"M", 94, 102},
                                {"L", 102, 110}, {"XL", 110, 118}, {"XXL", 118, 129}};
constexpr Range kWomensBust[] = {{"XS", 74, 82}, {"S", 82, 90},    {"M", 90, 98},
                                 {"L", 98, 107}, {"XL", 107, 119}, {"XXL", 119, 131}};
constexpr double kMensDrop_cm = 12, kWomensDrop_cm = 16;  // of the waist from chest and bust

// Women's hips over the bust, by the standard's steps: the difference shrinks as girths grow.
struct Step {
  double bust_cm, hip_cm;
};
constexpr Step kWomensHip[] = {{76, 84},   {80, 88},   {84, 92},   {88, 96},   {92, 100},  {96, 104},
                               {100, 108}, {104, 112}, {110, 117}, {116, 122}, {122, 127}, {128, 132}};

// ANSUR II men: means of buttock and waist girth, and the slope of one on the other (correlation .88 times 77 / 112).
constexpr double kMeanHip_cm = 102.0, kMeanWaist_cm = 94.1, kHipByWaist = 0.605;

double womens_hip_cm(double bust_cm) {
  const Step* step = std::begin(kWomensHip);
  while (step + 2 < std::end(kWomensHip) && step[1].bust_cm < bust_cm) ++step;
  const double t = (bust_cm - step[0].bust_cm) / (step[1].bust_cm - step[0].bust_cm);
  return step[0].hip_cm + t * (step[1].hip_cm - step[0].hip_cm);
}

SizeClass size_class(const Range& range, bool men) {
  constexpr double kCm = 0.01;
  const double chest_cm = (range.low_cm + range.high_cm) / 2,
               waist_cm = chest_cm - (men ? kMensDrop_cm : kWomensDrop_cm);
  const double hip_cm = men ? kMeanHip_cm + kHipByWaist * (waist_cm - kMeanWaist_cm) : womens_hip_cm(chest_cm);
  return {range.name, kCm * range.low_cm, kCm * range.high_cm, kCm * chest_cm, kCm * waist_cm, kCm * hip_cm};
}

}  // namespace

std::vector<SizeClass> size_chart(const std::string& sex) {
  if (sex != "men" && sex != "women")
    throw InputError("size chart", "found \"" + sex + "\"; expected one of men, women");
  std::vector<SizeClass> chart;
  if (sex == "men")
    for (const Range& range : kMensChest) chart.push_back(size_class(range, true));
  else
    for (const Range& range : kWomensBust) chart.push_back(size_class(range, false));
  return chart;
}

const SizeClass& class_of_chest(const std::vector<SizeClass>& chart, double chest_m) {
  if (chart.empty()) throw std::invalid_argument("class_of_chest: the chart has no classes");
  for (const SizeClass& each : chart)
    if (chest_m < each.chest_high_m) return each;
  return chart.back();
}

}  // namespace dressform
