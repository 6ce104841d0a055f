#include "eval/run/recorded_request.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "scenes/error.h"

namespace dressform {

namespace fs = std::filesystem;
using nlohmann::json;

EndToEndRequest recorded_request(const fs::path& run) {
  const fs::path file = run / "run.json";
  std::ifstream in(file);
  if (!in) throw InputError(file.string(), "can't be read; expected the run.json of a run folder");
  try {
    json facts = json::parse(in);
    EndToEndRequest request;
    request.session = facts.at("session").at("path").get<std::string>();
    request.output = run;
    request.store = facts.at("store").get<std::string>();
    request.scene = facts.at("scene");
    request.variant = facts.at("variant");
    request.options.seed = facts.at("seed");
    request.options.variants = facts.at("options").at("variants").get<std::map<std::string, std::string>>();
    for (const auto& [stage, values] : facts.at("options").at("values").items())
      for (const auto& [name, value] : values.items()) request.options.values[stage][name] = value.get<std::string>();
    for (const char* key : {"scene_file", "scene_toml", "scale", "sensor_model", "capture"})
      if (facts.contains(key)) request.facts[key] = facts[key];
    return request;
  } catch (const json::exception& error) {
    throw InputError(file.string(), std::string("damaged (") + error.what() + ")");
  }
}

}  // namespace dressform
