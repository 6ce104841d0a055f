#include "eval/wardrobe/sizes.h"

#include <cmath>
#include <utility>

#include "eval/metrics/girths.h"
#include "eval/wardrobe/graded_body.h"
#include "scenes/error.h"

namespace dressform {
namespace {

using metrics::TapeLevels;
constexpr double kToMillimetres = 1000;

struct Tape {
  const char* name;
  TapeLevels::Level TapeLevels::*level;
};
const Tape kSizeTapes[] = {{"chest", &TapeLevels::chest}, {"waist", &TapeLevels::waist}, {"hip", &TapeLevels::hip}};

TapeLevels levels_on(const Mesh& body, const std::string& whose) {
  const auto levels = metrics::tape_levels(body);
  if (!levels) throw InputError(whose, "found no trunk that a tape goes round; expected a standing body, m, y up");
  return *levels;
}

}  // namespace

SizedClothes clothes_in_size(const CapturedClothes& clothes, const SizeClass& size) {
  SizedClothes sized;
  sized.size = size;
  sized.body = graded_body(clothes.naked, {size.chest_m, size.waist_m, size.hip_m}, clothes.name + ": mannequin");
  sized.clothes = dressed(clothes, sized.body);
  return sized;
}

std::vector<SizeEase> size_eases(const CapturedClothes& clothes, const std::vector<SizedClothes>& sizes,
                                 const Mesh& customer) {
  const TapeLevels mannequin = levels_on(clothes.naked.body, clothes.name + ": mannequin");
  const TapeLevels wearer = levels_on(customer, "the customer");
  std::vector<SizeEase> eases;
  for (const SizedClothes& sized : sizes) {
    const TapeLevels graded = levels_on(sized.body.body, clothes.name + ": mannequin in size " + sized.size.name);
    for (const auto& [slot, garment] : sized.clothes.garments)
      for (const Tape& tape : kSizeTapes) {
        const auto cut = metrics::garment_girth_m(clothes.garments.garments.at(slot).mesh, mannequin.*tape.level);
        const auto girth = metrics::garment_girth_m(garment.mesh, graded.*tape.level);
        if (!cut || !girth) continue;
        eases.push_back({sized.size.name, slot, tape.name, kToMillimetres * *girth,
                         kToMillimetres * (*girth - (wearer.*tape.level).girth_m),
                         kToMillimetres * (*cut - (mannequin.*tape.level).girth_m)});
      }
  }
  return eases;
}

std::map<std::string, std::string> best_sizes(const std::vector<SizeEase>& eases) {
  struct Sum {
    double off_mm = 0;
    int tapes = 0;
  };
  std::vector<std::pair<std::pair<std::string, std::string>, Sum>> sums;  // (slot, size), smaller sizes first
  for (const SizeEase& each : eases) {
    const std::pair key{each.slot, each.size};
    auto found = sums.begin();
    while (found != sums.end() && found->first != key) ++found;
    if (found == sums.end()) found = sums.insert(found, {key, {}});
    found->second.off_mm += std::abs(each.ease_mm - each.meant_mm);
    ++found->second.tapes;
  }
  std::map<std::string, std::string> best;
  std::map<std::string, double> least_mm;
  for (const auto& [key, sum] : sums) {
    const double off_mm = sum.off_mm / sum.tapes;
    if (best.count(key.first) && least_mm[key.first] <= off_mm) continue;
    best[key.first] = key.second;
    least_mm[key.first] = off_mm;
  }
  return best;
}

}  // namespace dressform
