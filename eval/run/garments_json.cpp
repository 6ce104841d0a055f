#include "eval/run/garments_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace dressform {
namespace {

using nlohmann::ordered_json;

const char* name_of(Worn worn) {
  switch (worn) {
    case Worn::over:
      return "over";
    case Worn::under:
      return "under";
    default:
      return "alone";
  }
}

ordered_json limb_json(const LimbCover& limb) {
  if (!limb.covered) return nullptr;
  return {{"end_m", limb.end_m}};
}

ordered_json layout_json(const GarmentLayout& layout) {
  ordered_json json{{"kind", layout.kind},           {"sure_kind", layout.sure_kind}, {"worn", name_of(layout.worn)},
                    {"sure_worn", layout.sure_worn}, {"top_y_m", layout.top_y},       {"bottom_y_m", layout.bottom_y}};
  const char* sides[] = {"left", "right"};
  for (int side = 0; side < 2; ++side) {
    json["arms"][sides[side]] = limb_json(layout.arms[side]);
    json["legs"][sides[side]] = limb_json(layout.legs[side]);
  }
  return json;
}

}  // namespace

std::string garments_json(const OpenGarments& opened) {
  ordered_json json{{"garments", ordered_json::object()}, {"failed", ordered_json::object()}};
  for (const auto& [slot, garment] : opened.garments) {
    json["garments"][slot] = layout_json(garment.layout);
    for (const auto& rim : garment.rims)
      json["garments"][slot]["rims"][rim.name] = {{"observed", rim.observed}, {"unseen_part", rim.unseen_part()}};
  }
  for (const auto& [slot, why] : opened.failed) json["failed"][slot] = why;
  return json.dump(1) + "\n";
}

std::string word_of(const std::string& slot, const GarmentLayout& layout) {
  std::string text = fmt::format("{}: {} ({:.0f} % sure)", slot, layout.kind, 100 * layout.sure_kind);
  if (layout.worn != Worn::alone) text += fmt::format(", worn {} the other", name_of(layout.worn));
  const char* sides[] = {"left", "right"};
  for (int side = 0; side < 2; ++side)
    if (layout.arms[side].covered)
      text += fmt::format(", {} sleeve to {:.0f} mm below the armpit", sides[side], 1000 * layout.arms[side].end_m);
  return text + ". ";
}

}  // namespace dressform
