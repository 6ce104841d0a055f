#include "scenes/calibration_json.h"

#include "scenes/session_layout.h"
#include "scenes/session_limits.h"

namespace dressform {
namespace {

SensorCalibration read_sensor(const JsonValue& value) {
  SensorCalibration sensor;
  sensor.ir = value.at("ir").camera();
  if (value.has("model")) sensor.model = value.at("model").text();
  if (value.has("depth_offset_m")) sensor.depth_offset_m = value.at("depth_offset_m").number();
  if (value.has("color")) {  // a bare depth scanner has none
    sensor.color = value.at("color").camera();
    sensor.color_from_ir = value.at("color_from_ir").rigid();
  }
  if (const auto found = problem_with(sensor)) value.at(found->field).fail(found->problem);
  return sensor;
}

}  // namespace

Calibration read_calibration(const std::filesystem::path& file) {
  const JsonValue value = read_json(file, session_layout::kCalibrationFormat, session_layout::kVersion);
  const JsonValue sensors = value.at("sensors");
  Calibration calibration;
  for (const auto& name : sensors.names()) calibration.sensors[name] = read_sensor(sensors.at(name));
  return calibration;
}

nlohmann::ordered_json calibration_json(const Calibration& calibration) {
  auto sensors = nlohmann::ordered_json::object();
  for (const auto& [name, sensor] : calibration.sensors) {
    nlohmann::ordered_json value{{"model", sensor.model}};
    if (sensor.color) value["color"] = to_json(*sensor.color);
    value["ir"] = to_json(sensor.ir);
    if (sensor.color) value["color_from_ir"] = to_json(sensor.color_from_ir);
    value["depth_offset_m"] = sensor.depth_offset_m;
    sensors[name] = value;
  }
  return {{"format", session_layout::kCalibrationFormat}, {"version", session_layout::kVersion}, {"sensors", sensors}};
}

void write_calibration(const std::filesystem::path& file, const Calibration& calibration) {
  write_json(file, calibration_json(calibration));
}

}  // namespace dressform
