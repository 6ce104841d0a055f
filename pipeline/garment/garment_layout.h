#pragma once
#include <array>
#include <map>
#include <stdexcept>
#include <string>

#include "pipeline/body/body_landmarks.h"

namespace dressform {

// How a garment lies to the other one, where the two meet.
enum class Worn : unsigned char {
  alone,  // there is no other one, or they do not meet
  over,
  under,  // a shirt tucked into trousers, a waistband beneath a shirt
};

// One arm or leg: how far down it the garment goes. Metres along the limb's axis from its root; heights over the model
// frame's origin.
struct LimbCover {
  bool covered = false;  // the garment has a part that goes round this limb
  double end_m = 0;      // cuff or ankle
  double free_m = 0;     // from here on the cloth goes round the limb alone: of a sleeve, where it leaves the trunk's
  double end_y = 0;      // lowest cloth about a leg

  template <class Archive>
  void serialize(Archive& archive) {
    archive(covered, end_m, free_m, end_y);
  }
};

// What kind of garment it is and where it goes on the body: found by segment from the labelled pixels, refined by who
// sees more of it (surface: the cleaned cloud and the closed surface; open: the rims; fit: the user's body), and taken
// as it is by all stages after. Model frame of the body that wears it.
struct GarmentLayout {
  std::string kind;               // "shirt", "dress", "trousers", "skirt"
  std::array<LimbCover, 2> arms;  // left, right
  std::array<LimbCover, 2> legs;
  double top_y = 0, bottom_y = 0;  // highest and lowest cloth on trunk and legs: neck or waist; hem or ankles
  Worn worn = Worn::alone;
  double sure_kind = 0;  // 0-1: 0 as much speaks against this kind as for it
  double sure_worn = 0;

  bool forked() const { return kind == "trousers"; }  // a tube round each leg; else one round both
  bool upper() const { return kind == "shirt" || kind == "dress"; }

  template <class Archive>
  void serialize(Archive& archive) {
    auto order = static_cast<unsigned char>(worn);
    archive(kind, arms, legs, top_y, bottom_y, order, sure_kind, sure_worn);
    if (order > static_cast<unsigned char>(Worn::under))
      throw std::runtime_error("serialized data are damaged: an unknown order of two garments");
    worn = static_cast<Worn>(order);
  }
};
using GarmentLayouts = std::map<std::string, GarmentLayout>;  // "top", "bottom"

}  // namespace dressform
