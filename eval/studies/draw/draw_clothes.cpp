#include <fmt/format.h>

#include <array>

#include "eval/studies/draw/draw_parts.h"

namespace dressform {
namespace {

using Rgb = std::array<int, 3>;

const std::vector<std::string> kPlain{"plain", "weave", "denim"};
const std::vector<std::string> kBusy{"stars", "characters", "stripes", "plaid", "all_over", "complex", "noise"};
constexpr int kAlike = 24;  // levels of sRGB in every channel: two shades of one colour

std::string hex(const Rgb& color) { return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]); }

Rgb rgb(const std::string& text) {
  Rgb color;
  for (int c = 0; c < 3; ++c) color[c] = std::stoi(text.substr(1 + 2 * c, 2), nullptr, 16);
  return color;
}

Rgb shifted(const Rgb& color, int levels) {
  Rgb result;
  for (int c = 0; c < 3; ++c) result[c] = std::clamp(color[c] + levels, 8, 247);
  return result;
}

int level(double value) { return std::clamp(static_cast<int>(std::lround(255 * value)), 8, 247); }

// A dye: hue, chroma and lightness of HSL. Clothes are mostly dark, many are black, grey, white or blue.
Rgb draw_dye(const Dice& dice) {
  const std::string family = dice.weighted("family", {{"grey", 0.35}, {"blue", 0.2}, {"earth", 0.15}, {"any", 0.3}});
  double hue = dice.between("hue", 0, 360, 0), chroma = dice.between("chroma", 0.25, 0.75);
  double light = dice.chance("dark", 0.6) ? dice.between("lightness", 0.08, 0.35) : dice.between("lightness", 0.4, 0.9);
  if (family == "grey") chroma = dice.between("chroma", 0, 0.05);
  if (family == "blue") hue = dice.between("hue", 205, 240, 0);
  if (family == "earth") hue = dice.between("hue", 15, 50, 0), chroma *= 0.6;
  const double half = chroma * std::min(light, 1 - light);
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + hue / 30, 12);
    return level(light - half * std::max(-1.0, std::min({k - 3, 9 - k, 1.0})));
  };
  return {channel(0), channel(8), channel(4)};
}

// Ground and three inks; an ink that the ground would swallow is made lighter or darker.
std::vector<std::string> draw_colors(const std::string& kind, const Dice& dice) {
  const Rgb ground = draw_dye(dice.part("ground"));
  if (kind == "plain") return {hex(ground)};
  if (kind == "weave" || kind == "denim") return {hex(ground), hex(shifted(ground, dice.whole("yarn", 8, 24)))};
  std::vector<std::string> colors{hex(ground)};
  const bool dark = ground[0] + ground[1] + ground[2] < 3 * 110;
  for (int ink = 1; ink <= 3; ++ink) {
    Rgb color = draw_dye(dice.part("ink" + std::to_string(ink)));
    int apart = 0;
    for (int c = 0; c < 3; ++c) apart = std::max(apart, std::abs(color[c] - ground[c]));
    if (apart < 60) color = shifted(color, dark ? 110 : -110);
    colors.push_back(hex(color));
  }
  return colors;
}

PrintSpec draw_print(const DrawnWishes& wishes, double busy_chance, const Dice& dice) {
  const bool busy = wishes.prints == "busy" || (wishes.prints == "any" && dice.chance("busy", busy_chance));
  PrintSpec print;
  print.kind = dice.one_of("kind", busy ? kBusy : kPlain);
  print.colors = draw_colors(print.kind, dice);
  if (print.kind == "stars" || print.kind == "complex")
    print.text = dice.one_of("text", std::vector<std::string>{"", "STAR 88", "WILD", "OSLO", "NO 7"});
  return print;
}

// Two shades of one colour, neither printed with anything.
void make_alike(GarmentSpec& top, GarmentSpec& bottom, const Dice& dice) {
  for (GarmentSpec* garment : {&top, &bottom}) {
    garment->print.kind = "weave";
    garment->print.text.clear();
  }
  const Rgb ground = rgb(top.print.colors.front());
  const Rgb other = shifted(ground, dice.whole("shade", -8, 8));
  top.print.colors = {hex(ground), hex(shifted(ground, 10))};
  bottom.print.colors = {hex(other), hex(shifted(other, 10))};
}

void draw_cloth(GarmentSpec& garment, const Dice& dice) {
  garment.fullness = dice.between("fullness", 0.03, 0.11);
  garment.bending_length_m = dice.between("bending", 0.012, 0.028);
}

void draw_sleeve(GarmentSpec& garment, const DrawnWishes& wishes, double long_chance, const Dice& dice) {
  const bool long_sleeve = wishes.long_sleeves || dice.chance("long", long_chance);
  garment.sleeve = long_sleeve ? dice.between("sleeve", 0.88, 0.98) : dice.between("sleeve", 0.22, 0.55);
}

GarmentSpec draw_shirt(const DrawnWishes& wishes, double size, const Dice& dice) {
  GarmentSpec shirt;
  shirt.slot = "top";
  shirt.kind = "shirt";
  shirt.collar = dice.weighted("collar", {{"none", 0.72}, {"polo", 0.18}, {"hood", 0.10}});
  draw_sleeve(shirt, wishes, shirt.collar == "hood" ? 1.0 : 0.4, dice);
  shirt.tucked = wishes.tucked || (shirt.collar != "hood" && dice.chance("tucked", 0.2));
  if (shirt.tucked && shirt.collar == "hood") shirt.collar = "none";
  const bool v_neck = shirt.collar == "none" && dice.chance("v neck", 0.25);
  if (v_neck) shirt.neck = "v";
  shirt.neck_depth_m = v_neck ? dice.between("v depth", 0.13, 0.17) : dice.between("depth", 0.07, 0.12);
  shirt.hem_below_waist_m = Dice::rounded(size * dice.between("hem", 0.14, 0.27), 3);
  shirt.ease_m = dice.between("ease", 0.06, 0.18);
  draw_cloth(shirt, dice);
  shirt.print = draw_print(wishes, 0.65, dice.part("print"));
  shirt.name = shirt.collar == "polo" ? "polo shirt" : shirt.collar == "hood" ? "hooded top" : "shirt";
  return shirt;
}

GarmentSpec draw_dress(const DrawnWishes& wishes, const Dice& dice) {
  GarmentSpec dress;
  dress.slot = "top";
  dress.kind = dress.name = "dress";
  draw_sleeve(dress, wishes, 0.2, dice);
  dress.length = dice.between("length", 0.45, 0.85);
  dress.neck_depth_m = dice.between("depth", 0.08, 0.14);
  dress.ease_m = dice.between("ease", 0.06, 0.13);
  dress.flare = dice.between("flare", 0.2, 0.8);
  draw_cloth(dress, dice);
  dress.print = draw_print(wishes, 0.65, dice.part("print"));
  return dress;
}

GarmentSpec draw_bottom(const DrawnWishes& wishes, const std::string& kind, const Dice& dice) {
  GarmentSpec bottom;
  bottom.slot = "bottom";
  bottom.name = kind;
  bottom.kind = kind == "skirt" ? "skirt" : "trousers";
  bottom.length = kind == "skirt"    ? dice.between("skirt length", 0.35, 0.9)
                  : kind == "shorts" ? dice.between("shorts length", 0.35, 0.55)
                                     : dice.between("length", 0.88, 1.02);
  bottom.waist_offset_m = dice.between("waist", -0.05, 0.02);
  bottom.ease_m = dice.between("ease", 0.05, 0.13);
  if (kind == "skirt") {
    bottom.flare = dice.between("flare", 0.1, 0.9);
    if (dice.chance("slanted", 0.2)) bottom.hem_slant = dice.between("slant", -0.1, 0.15);
  }
  draw_cloth(bottom, dice);
  bottom.print = draw_print(wishes, 0.25, dice.part("print"));
  return bottom;
}

std::string draw_kind(const DrawnWishes& wishes, const BodySpec& wearer, const Dice& dice) {
  if (wishes.clothes != "any") return wishes.clothes;
  const bool alone = wishes.tucked || wishes.same_colors;  // these need two garments
  if (wearer.sex == "male") return dice.weighted("kind", {{"trousers", 0.67}, {"shorts", 0.3}, {"skirt", 0.03}});
  return dice.weighted("kind", {{"trousers", 0.45}, {"shorts", 0.15}, {"skirt", 0.22}, {"dress", alone ? 0.0 : 0.18}});
}

}  // namespace

bool colors_alike(const GarmentSpec& a, const GarmentSpec& b) {
  const Rgb first = rgb(a.print.colors.front()), second = rgb(b.print.colors.front());
  for (int c = 0; c < 3; ++c)
    if (std::abs(first[c] - second[c]) > kAlike) return false;
  return true;
}

std::vector<GarmentSpec> draw_clothes(const DrawnWishes& wishes, const BodySpec& wearer, const Dice& dice) {
  const std::string kind = draw_kind(wishes, wearer, dice);
  if (kind == "dress") return {draw_dress(wishes, dice.part("dress"))};
  constexpr double kUsualStature_m = 1.75;
  GarmentSpec top = draw_shirt(wishes, wearer.stature_m / kUsualStature_m, dice.part("shirt"));
  GarmentSpec bottom = draw_bottom(wishes, kind, dice.part("bottom"));
  if (wishes.same_colors) make_alike(top, bottom, dice);
  return {top, bottom};
}

}  // namespace dressform
