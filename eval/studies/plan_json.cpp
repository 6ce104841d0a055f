#include "eval/studies/plan_json.h"

#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

using nlohmann::json;

json values_json(const FieldValues& values) {
  json result = json::object();
  for (const auto& [name, value] : values)
    std::visit([&, &name = name](const auto& held) { result[name] = held; }, value);
  return result;
}

FieldValues values_from(const json& text) {
  FieldValues values;
  for (const auto& [name, value] : text.items()) {
    if (value.is_boolean())
      values[name] = value.get<bool>();
    else if (value.is_number_integer())
      values[name] = value.get<int>();
    else if (value.is_number())
      values[name] = value.get<double>();
    else
      values[name] = value.get<std::string>();
  }
  return values;
}

StudyVariant variant_from(const json& text) {
  StudyVariant variant;
  variant.name = text.at("name");
  variant.options.variants = text.at("stages").get<std::map<std::string, std::string>>();
  for (const auto& [stage, values] : text.at("set").items()) variant.options.values[stage] = values_from(values);
  variant.sensor.variant = text.at("sensor");
  variant.sensor.values = values_from(text.at("sensor_values"));
  variant.scale = text.at("scale");
  variant.rig = text.at("rig").get<std::string>();
  variant.scan = text.at("scan").get<std::string>();
  if (text.contains("oracles")) variant.oracles = text.at("oracles").get<std::vector<std::string>>();
  if (text.contains("foreign")) variant.foreign = foreign_from_json(text.at("foreign"));
  return variant;
}

json metric_json(const StudyMetric& metric) {
  return {{"metric", metric.text}, {"primary", metric.primary}, {"margin", metric.margin}};
}

StudyMetric metric_from(const json& text, const std::string& where) {
  StudyMetric metric = study_metric(where, text.at("metric"));
  metric.primary = text.at("primary");
  metric.margin = text.at("margin");
  return metric;
}

json scene_json(const PlannedScene& scene) {
  return {{"name", scene.name},
          {"recording", scene.recording},
          {"path", scene.path.string()},
          {"content_hash", scene.content_hash},
          {"strata", scene.strata}};
}

PlannedScene scene_from(const json& text) {
  return {text.at("name"), text.at("recording"), text.at("path").get<std::string>(), text.at("content_hash"),
          text.at("strata").get<std::vector<std::string>>()};
}

StudyPlan plan_from(const json& text, const std::string& where) {
  StudyPlan plan;
  Study& study = plan.study;
  study.name = text.at("name");
  study.description = text.at("description");
  study.scale = text.at("scale");
  study.seeds = text.at("seeds").get<std::vector<Seed>>();
  study.baseline = text.at("baseline");
  for (const auto& metric : text.at("metrics")) study.metrics.push_back(metric_from(metric, where));
  for (const auto& variant : text.at("variants")) study.variants.push_back(variant_from(variant));
  for (const auto& scene : text.at("scenes")) plan.scenes.push_back(scene_from(scene));
  return plan;
}

}  // namespace

json variant_json(const StudyVariant& variant, bool with_name) {
  json set = json::object();
  for (const auto& [stage, values] : variant.options.values) set[stage] = values_json(values);
  json text = {{"stages", variant.options.variants},
               {"set", set},
               {"sensor", variant.sensor.variant},
               {"sensor_values", values_json(variant.sensor.values)},
               {"scale", variant.scale}};
  if (!variant.oracles.empty()) text["oracles"] = variant.oracles;
  if (variant.foreign) text["foreign"] = foreign_json(*variant.foreign, with_name);
  if (!with_name) return text;
  text["name"] = variant.name;
  text["rig"] = variant.rig.string();
  text["scan"] = variant.scan.string();
  return text;
}

std::string plan_json(const StudyPlan& plan) {
  const Study& study = plan.study;
  json variants = json::array(), metrics = json::array(), scenes = json::array();
  for (const auto& variant : study.variants) variants.push_back(variant_json(variant, true));
  for (const auto& metric : study.metrics) metrics.push_back(metric_json(metric));
  for (const auto& scene : plan.scenes) scenes.push_back(scene_json(scene));
  const json text = {{"format", "dressform-study"}, {"version", 1},
                     {"name", study.name},          {"description", study.description},
                     {"scale", study.scale},        {"seeds", study.seeds},
                     {"baseline", study.baseline},  {"metrics", metrics},
                     {"variants", variants},        {"scenes", scenes}};
  return text.dump(1) + "\n";
}

StudyPlan plan_from_json(const std::filesystem::path& file) {
  try {
    const json text = json::parse(read_file_bytes(file));
    if (text.at("format") != "dressform-study" || text.at("version") != 1)
      throw InputError(file.string(), "is not a dressform-study of version 1");
    return plan_from(text, file.string());
  } catch (const json::exception& error) {
    throw InputError(file.string(), std::string("damaged (") + error.what() + "); expected a planned study");
  }
}

}  // namespace dressform
