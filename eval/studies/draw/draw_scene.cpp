#include "eval/studies/draw/draw_scene.h"

#include <fmt/format.h>

#include <set>

#include "eval/studies/draw/draw_parts.h"
#include "scenes/error.h"
#include "synthetic/sensors/sensor_model.h"

namespace dressform {
namespace {

constexpr double kLongSleeve = 0.8;  // of the arm

// One word where options and strata agree, an error where they do not.
void settle(std::string& wish, const std::string& word, const std::string& stratum, const char* option) {
  if (wish != "any" && wish != word)
    throw InputError("stratum " + stratum,
                     fmt::format("found {} = \"{}\" beside it; expected \"{}\" or \"any\"", option, wish, word));
  wish = word;
}

std::set<std::string> known_names(const std::vector<std::string>& strata) {
  std::string known;
  std::set<std::string> all, asked;
  for (const auto& each : known_strata()) {
    all.insert(each.name);
    known += (known.empty() ? "" : ", ") + std::string(each.name);
  }
  for (const auto& stratum : strata) {
    if (!all.count(stratum)) throw InputError("stratum " + stratum, "not known; expected some of " + known);
    asked.insert(stratum);
  }
  return asked;
}

void check_exclusive(const DrawnWishes& wishes, const std::set<std::string>& strata) {
  if (wishes.clothes == "dress" && (wishes.tucked || wishes.same_colors))
    throw InputError(wishes.tucked ? "stratum tucked" : "stratum same_colours",
                     "found a dress, which is worn alone; expected clothes = trousers, shorts or skirt");
  if (wishes.sensors != 0 && wishes.sensors < 3)
    throw InputError("sensors", fmt::format("found {}; expected 3 to 8, or 0 for any number", wishes.sensors));
  if (strata.count("three_sensors") && wishes.sensors != 3)
    throw InputError("stratum three_sensors",
                     fmt::format("found sensors = {} beside it; expected 3 or 0", wishes.sensors));
  SensorModel::at(wishes.sensor_model);
}

DrawnWishes wishes_of(const DrawOptions& options) {
  const std::set<std::string> strata = known_names(options.strata);
  DrawnWishes wishes{options.people, options.clothes, options.prints,
                     options.rooms,  options.sensors, options.sensor_model};
  for (const char* kind : {"skirt", "dress"})
    if (strata.count(kind)) settle(wishes.clothes, kind, kind, "clothes");
  if (strata.count("three_sensors") && wishes.sensors == 0) wishes.sensors = 3;
  wishes.tucked = strata.count("tucked");
  wishes.long_sleeves = strata.count("long_sleeves");
  wishes.same_colors = strata.count("same_colours");
  wishes.stout = strata.count("stout");
  wishes.child = strata.count("child_sized");
  check_exclusive(wishes, strata);
  return wishes;
}

std::string described(const DrawnScene& scene) {
  std::string clothes;
  for (const auto& garment : scene.garments) clothes += (clothes.empty() ? "" : ", ") + garment.name;
  return fmt::format("Drawn: a {} of {:.2f} m in {}, before {} sensors", scene.body.sex == "male" ? "man" : "woman",
                     scene.body.stature_m, clothes, scene.rig.size());
}

}  // namespace

const std::vector<Stratum>& known_strata() {
  static const std::vector<Stratum> strata{{"skirt", "a skirt below a shirt"},
                                           {"dress", "a dress"},
                                           {"tucked", "the shirt worn inside what is below"},
                                           {"long_sleeves", "sleeves to the wrist"},
                                           {"three_sensors", "a rig of three"},
                                           {"same_colours", "shirt and trousers or skirt hardly told apart by colour"},
                                           {"stout", "a waist 1.3 deviations above the mean"},
                                           {"child_sized", "a wearer below 1.5 m, of a child's build"}};
  return strata;
}

DrawnScene draw_scene(const DrawOptions& options, Seed seed) {
  const DrawnWishes wishes = wishes_of(options);
  const Dice dice(seed);
  DrawnScene scene;
  scene.name = fmt::format("drawn{}", seed);
  for (const auto& stratum : options.strata) scene.name += "_" + stratum;
  scene.body = draw_wearer(wishes, dice.part("wearer"));
  scene.user = draw_customer(wishes, scene.body, dice.part("customer"));
  scene.garments = draw_clothes(wishes, scene.body, dice.part("clothes"));
  scene.rig = draw_rig(wishes, scene.body, dice.part("rig"));
  scene.scan = draw_scan(wishes, dice.part("scan"));
  scene.room = draw_room(wishes, scene.rig, scene.scan, dice.part("room"));
  scene.lights = draw_lights(scene.room, dice.part("lights"));
  scene.prior.rotation_deg = dice.between("prior rotation", 2, 6, 2);
  scene.prior.translation_m = dice.between("prior translation", 0.03, 0.10);
  scene.sensor_model = wishes.sensor_model;
  scene.description = described(scene);
  return scene;
}

std::vector<std::string> strata_of(const DrawnScene& scene) {
  std::set<std::string> found;
  for (const auto& garment : scene.garments) {
    if (garment.kind == "skirt" || garment.kind == "dress") found.insert(garment.kind);
    if (garment.tucked) found.insert("tucked");
    if (garment.slot == "top" && garment.sleeve >= kLongSleeve) found.insert("long_sleeves");
  }
  if (scene.garments.size() == 2 && colors_alike(scene.garments[0], scene.garments[1])) found.insert("same_colours");
  if (scene.rig.size() == 3) found.insert("three_sensors");
  if (scene.body.stature_m < kChildBelow_m) found.insert("child_sized");
  if (is_stout(scene.body)) found.insert("stout");
  std::vector<std::string> ordered;
  for (const auto& stratum : known_strata())
    if (found.count(stratum.name)) ordered.push_back(stratum.name);
  return ordered;
}

}  // namespace dressform
