#include <fmt/format.h>

#include "eval/studies/draw/draw_scene.h"

namespace dressform {
namespace {

// Shortest text that reads back the same; a whole number is still written as a real one.
std::string toml_number(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == text.npos ? text + ".0" : text;
}

std::string toml_text(const std::string& text) {
  std::string result = "\"";
  for (const char letter : text)
    result += letter == '"' || letter == '\\' ? std::string("\\") + letter : std::string(1, letter);
  return result + "\"";
}

std::string toml_value(const FieldValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return toml_number(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return toml_text(*text);
  return to_text(value);
}

// The fields of a struct that differ from its defaults, and those that are asked for by name.
template <class Spec>
std::string toml_fields(const Spec& spec, const std::vector<std::string>& always = {}) {
  const auto usual = list_fields(Spec{}), given = list_fields(spec);
  std::string text;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const bool wanted = std::find(always.begin(), always.end(), given[i].name) != always.end();
    if (wanted || given[i].value != usual[i].value) text += given[i].name + " = " + toml_value(given[i].value) + "\n";
  }
  return text;
}

template <class Vector>
std::string toml_numbers(const Vector& values, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += (i ? ", " : "") + toml_number(values[i]);
  return "[" + text + "]";
}

std::string toml_camera(const Camera& camera) {
  return fmt::format("{{width = {}, height = {}, fx = {}, fy = {}, cx = {}, cy = {}, distortion = {}}}", camera.width,
                     camera.height, toml_number(camera.fx), toml_number(camera.fy), toml_number(camera.cx),
                     toml_number(camera.cy), toml_numbers(camera.distortion, 5));
}

std::string toml_room(const DrawnScene& scene) {
  std::string text = "\n[room]\n" + toml_fields(scene.room, {"width_m", "depth_m", "height_m", "furniture"});
  for (const auto& light : scene.lights)
    text += fmt::format("\n[[room.light]]\nposition_m = {}\nradius_m = {}\nintensity_rgb = {}\n",
                        toml_numbers(light.position_m, 3), toml_number(light.radius_m),
                        toml_numbers(light.intensity_rgb, 3));
  return text;
}

std::string toml_body(const std::string& table, const BodySpec& body) {
  return "\n[" + table + "]\n" +
         toml_fields(body, {"sex", "stature_m", "chest_m", "waist_m", "hip_m", "pose", "arm_angle_deg"});
}

std::string toml_garment(const GarmentSpec& garment) {
  std::string text = "\n[[garment]]\n" + toml_fields(garment, {"name", "kind", "ease_m", "fullness"});
  text += "[garment.print]\n" + toml_fields(garment.print, {"kind"}) + "colors = [";
  for (std::size_t i = 0; i < garment.print.colors.size(); ++i)
    text += (i ? ", " : "") + toml_text(garment.print.colors[i]);
  return text + "]\n";
}

std::string toml_sensor(const DrawnSensor& sensor) {
  const SensorSpec& spec = sensor.spec;
  std::string text =
      fmt::format("\n[[rig.sensor]]\nname = {}\nmodel = {}\n", toml_text(spec.name), toml_text(spec.calibration.model));
  if (spec.body_tracking) text += "body_tracking = true\n";
  text += toml_fields(sensor.place, {"azimuth_deg", "distance_m", "height_m"});
  text += fmt::format("exposure = {}\ngain = {}\nwhite_balance = {}\n", toml_number(spec.exposure),
                      toml_number(spec.gain), toml_numbers(spec.white_balance, 3));
  text += "color = " + toml_camera(*spec.calibration.color) + "\nir = " + toml_camera(spec.calibration.ir) + "\n";
  return text + "[rig.sensor.color_from_ir]\ntranslation_m = " +
         toml_numbers(spec.calibration.color_from_ir.translation(), 3) + "\n";
}

std::string toml_strata(const DrawnScene& scene) {
  std::string words;
  for (const auto& stratum : strata_of(scene)) words += (words.empty() ? "" : ", ") + stratum;
  return "# strata: " + (words.empty() ? "none" : words) + "\n";
}

}  // namespace

std::string scene_toml(const DrawnScene& scene) {
  std::string text = toml_strata(scene) + "name = " + toml_text(scene.name) + "\n";
  text += "description = " + toml_text(scene.description) + "\n";
  text += "\n[sensor]\nmodel = " + toml_text(scene.sensor_model) + "\n";
  text += "\n[prior]\n" + toml_fields(scene.prior, {"rotation_deg", "translation_m"});
  text += toml_room(scene) + toml_body("body", scene.body) + toml_body("user", scene.user);
  for (const auto& garment : scene.garments) text += toml_garment(garment);
  for (const auto& sensor : scene.rig) text += toml_sensor(sensor);
  text += "\n[scan]\n" + toml_fields(scene.scan, {"frames", "radius_m", "height_m"});
  return text + "\n[scan.sensor]\nmodel = " + toml_text(scene.scan.calibration.model) +
         "\nir = " + toml_camera(scene.scan.calibration.ir) + "\n";
}

}  // namespace dressform
