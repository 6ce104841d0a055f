#include "eval/inspect/inspect_sensor.h"

#include <fmt/format.h>

#include "eval/inspect/sensor_charts.h"

namespace dressform {
namespace {

struct Part {
  const char* name;
  InspectionSection (*make)(const SensorSetup&);
  bool without_noise = false;
};

std::vector<Part> parts_of(const std::string& model) {
  std::vector<Part> parts{{"noise by distance", sigma_by_distance}, {"noise by incidence", sigma_by_angle},
                          {"noise by albedo", sigma_by_albedo},     {"holes", holes_by_angle},
                          {"flying pixels", flying_by_gap},         {"correlation", autocorrelation},
                          {"decoding", decoding_by_distance, true}};
  if (!those_it_has(model, {{"clip", 1.0}}).empty()) parts.push_back({"wiggling", wiggling, true});
  if (device_of(model).levels_mm) parts.push_back({"levels", levels});
  return parts;
}

}  // namespace

Inspection inspect_sensor(const std::string& model, const FieldValues& values, const InspectionProgress& progress) {
  SensorModel::at(model).complete(values);  // throws
  const auto setup = [&](FieldValues own) {
    FieldValues all = values;
    all.merge(own);  // what the user asks for goes first
    return SensorSetup{model, all, usual_camera(model)};
  };
  const SensorSetup noise = setup(noise_only(model)), still = setup(without_noise(model));
  Inspection inspection;
  inspection.title = "Sensor model " + model;
  inspection.summary = fmt::format(
      "Measured on planes, edges and floors of known depth at {} x {} pixels, beside published figures. For noise, "
      "what "
      "moves the mean is switched off; for decoding and wiggling, noise is.",
      noise.camera.width, noise.camera.height);
  const auto parts = parts_of(model);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    progress(parts[i].name, static_cast<int>(i), static_cast<int>(parts.size()));
    inspection.sections.push_back(parts[i].make(parts[i].without_noise ? still : noise));
  }
  return inspection;
}

}  // namespace dressform
