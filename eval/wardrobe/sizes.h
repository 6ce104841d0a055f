#pragma once
#include <map>
#include <string>
#include <vector>

#include "eval/wardrobe/dressing.h"
#include "eval/wardrobe/size_chart.h"

namespace dressform {

// The clothes made for a size class: on the mannequin graded to the class's girths.
struct SizedClothes {
  SizeClass size;
  KnownBody body;
  Dressed clothes;
};
// Throws InputError as graded_body and the stages do.
SizedClothes clothes_in_size(const CapturedClothes& clothes, const SizeClass& size);

// The room that a garment of a size has at a tape, millimetres: on the customer, and as it was cut, on the mannequin.
struct SizeEase {
  std::string size, slot, tape;  // tape: "chest", "waist", "hip"
  double garment_girth_mm = 0, ease_mm = 0, meant_mm = 0;
};
// Of all sizes, slots and tapes that the garments go round. `customer`: girths of who is to wear them.
std::vector<SizeEase> size_eases(const CapturedClothes& clothes, const std::vector<SizedClothes>& sizes,
                                 const Mesh& customer);

// For each slot the size whose ease is nearest to what was meant, in the mean over the tapes; the smaller one of
// equals. Slots that no tape goes round are left out.
std::map<std::string, std::string> best_sizes(const std::vector<SizeEase>& eases);

}  // namespace dressform
