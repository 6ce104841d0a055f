#include "eval/studies/study_variants.h"

#include <fmt/format.h>

#include <functional>

#include "eval/oracle/oracle.h"
#include "eval/studies/checked_values.h"
#include "pipeline/run/preset.h"
#include "synthetic/sensors/sensor_model.h"

namespace dressform {
namespace {

// One of the values that a key may have: its word in the variant's name, and what it does.
struct Choice {
  std::string word;
  std::function<void(StudyVariant&)> apply;
};
using Axis = std::vector<Choice>;

constexpr std::size_t kMostVariants = 1000;  // of one table: a grid with a slip in it would run for months

// The elements of an array, or the one value that stands alone.
std::vector<const toml::node*> values_of(const toml::node& node) {
  const auto* array = node.as_array();
  if (!array) return {&node};
  if (array->empty()) throw InputError(where_of(node), "found an empty array; expected values");
  std::vector<const toml::node*> values;
  for (const auto& element : *array) values.push_back(&element);
  return values;
}

std::string text_of(const toml::node& node, const std::string& name) {
  if (!node.is_string()) wrong_value(node, name, "text, or an array of text");
  return node.as_string()->get();
}

const toml::table& table_of(const toml::node& node, const std::string& name) {
  const auto* table = node.as_table();
  if (!table) wrong_value(node, name, "a table");
  return *table;
}

void take_preset(StudyVariant& variant, const Preset& preset) {
  for (const auto& [stage, name] : preset.variants) choose_variant(variant.options, stage, name);
  for (const auto& [stage, values] : preset.values)
    for (const auto& [name, value] : values) variant.options.values[stage][name] = value;
}

// preset = "thesis", or a file named from the study's folder. Before stages and set, which override it.
void add_preset_axis(TomlSection& section, std::vector<Axis>& axes) {
  const toml::node* node = section.find("preset");
  if (!node) return;
  Axis axis;
  for (const auto* each : values_of(*node)) {
    const std::string text = text_of(*each, "preset");
    const Preset preset = read_preset(is_preset_file(text) ? resolved_path(*each, text).string() : text);
    axis.push_back({preset.name, [preset](StudyVariant& variant) { take_preset(variant, preset); }});
  }
  axes.push_back(axis);
}

// stages = {surface = "tsdf"} or {surface = ["tsdf", "poisson"]}.
void add_stage_axes(TomlSection& section, std::vector<Axis>& axes) {
  const toml::node* node = section.find("stages");
  if (!node) return;
  for (const auto& [key, value] : table_of(*node, "stages")) {
    const auto& stage = stage_at(value, std::string(key.str()));
    Axis axis;
    for (const auto* each : values_of(value)) {
      const std::string name = variant_at(*each, stage, text_of(*each, stage.name)).name;
      axis.push_back({stage.name + "=" + name, [stage = stage.name, name](StudyVariant& variant) {
                        choose_variant(variant.options, stage, name);
                      }});
    }
    axes.push_back(axis);
  }
}

// Checked against the variant that the stage has by then.
void set_parameter(StudyVariant& variant, const toml::node& node, const std::string& stage, const std::string& name) {
  const std::string full = "set." + stage + "." + name;
  if (stage == "sensor") {
    const std::string& model = variant.sensor.variant;
    if (model.empty())  // scenes have models of their own, and each model its own parameters
      throw InputError(where_of(node),
                       full + ": found no sensor model beside it; expected sensor = \"...\" of the variant");
    variant.sensor.values[name] =
        checked_value(node, full, field_at(node, "sensor " + model, SensorModel::at(model).fields, name));
    return;
  }
  const auto& description = stage_at(node, stage);
  const auto chosen = variant.options.variants.find(stage);
  const auto& entry = variant_at(
      node, description, chosen == variant.options.variants.end() ? description.default_variant : chosen->second);
  variant.options.values[stage][name] =
      checked_value(node, full, field_at(node, stage + "." + entry.name, entry.fields, name));
}

std::string value_word(const toml::node& node) {
  if (const auto text = node.value<std::string>()) return *text;
  if (node.is_boolean()) return node.as_boolean()->get() ? "true" : "false";
  if (const auto whole = node.as_integer()) return fmt::format("{}", whole->get());
  if (const auto number = node.as_floating_point()) return fmt::format("{:g}", number->get());
  throw InputError(where_of(node), "found a table; expected a number, text, true or false");
}

// [variant.set.fuse] voxel_m = 0.004 or [0.003, 0.005]; set.sensor are those of the model that `sensor` names.
void add_parameter_axes(TomlSection& section, std::vector<Axis>& axes) {
  const toml::node* node = section.find("set");
  if (!node) return;
  for (const auto& [stage_key, parameters] : table_of(*node, "set")) {
    const std::string stage(stage_key.str());
    if (stage != "sensor") stage_at(parameters, stage);
    for (const auto& [key, value] : table_of(parameters, "set." + stage)) {
      const std::string name(key.str());
      Axis axis;
      for (const auto* each : values_of(value))
        axis.push_back({fmt::format("{}.{}={}", stage, name, value_word(*each)),
                        [each, stage, name](StudyVariant& variant) { set_parameter(variant, *each, stage, name); }});
      axes.push_back(axis);
    }
  }
}

void add_sensor_axis(TomlSection& section, std::vector<Axis>& axes) {
  const toml::node* node = section.find("sensor");
  if (!node) return;
  Axis axis;
  for (const auto* each : values_of(*node)) {
    const std::string model = text_of(*each, "sensor");
    const auto known = SensorModel::names();
    if (std::find(known.begin(), known.end(), model) == known.end())
      throw InputError(where_of(*each),
                       fmt::format("sensor: found \"{}\"; expected one of {}", model, fmt::join(known, ", ")));
    axis.push_back({"sensor=" + model, [model](StudyVariant& variant) { variant.sensor = {model, {}}; }});
  }
  axes.push_back(axis);
}

void add_file_axis(TomlSection& section, const char* key, std::filesystem::path StudyVariant::*file,
                   std::vector<Axis>& axes) {
  const toml::node* node = section.find(key);
  if (!node) return;
  Axis axis;
  for (const auto* each : values_of(*node)) {
    const auto path = std::filesystem::absolute(resolved_path(*each, text_of(*each, key)));
    axis.push_back({fmt::format("{}={}", key, path.stem().string()),
                    [path, file](StudyVariant& variant) { variant.*file = path; }});
  }
  axes.push_back(axis);
}

// oracle = "open": truth stands in for a stage's result.
void add_oracle_axis(TomlSection& section, std::vector<Axis>& axes) {
  const toml::node* node = section.find("oracle");
  if (!node) return;
  Axis axis;
  for (const auto* each : values_of(*node)) {
    const std::string label = text_of(*each, "oracle");
    check_oracle(where_of(*each) + ": oracle", label);
    axis.push_back({"oracle." + label, [label](StudyVariant& variant) { variant.oracles = {label}; }});
  }
  axes.push_back(axis);
}

// One a stage that truth can stand in for, alone.
std::vector<StudyVariant> all_oracles() {
  std::vector<StudyVariant> variants;
  for (const auto& label : oracle_labels()) {
    StudyVariant variant;
    variant.name = "oracle." + label;
    variant.oracles = {label};
    variants.push_back(variant);
  }
  return variants;
}

void add_scale_axis(TomlSection& section, std::vector<Axis>& axes) {
  const toml::node* node = section.find("scale");
  if (!node) return;
  Axis axis;
  const FieldInfo scale{"scale", 1.0, 0.1, 1.0, {}, "", ""};
  for (const auto* each : values_of(*node)) {
    const double value = std::get<double>(checked_value(*each, "variant.scale", scale));
    axis.push_back({fmt::format("scale={:g}", value), [value](StudyVariant& variant) { variant.scale = value; }});
  }
  axes.push_back(axis);
}

// Of one variant of all axes' choices; `place` counts them through.
StudyVariant combination(const std::vector<Axis>& axes, const std::string& name, std::size_t place) {
  StudyVariant variant;
  std::string words;
  for (const auto& axis : axes) {
    const Choice& choice = axis[place % axis.size()];
    place /= axis.size();
    choice.apply(variant);
    if (name.empty() || axis.size() > 1) words += (words.empty() ? "" : " ") + choice.word;
  }
  variant.name = name.empty() ? (words.empty() ? "default" : words) : words.empty() ? name : name + " " + words;
  return variant;
}

std::vector<std::string> only_stages(TomlSection& section) {
  std::vector<std::string> only;
  section.texts("of", only);
  for (const auto& name : only) stage_at(*section.find("of"), name);
  return only;
}

// The default, then every other variant of every stage: those that work by themselves, or with `picked` all of them.
std::vector<StudyVariant> one_at_a_time(TomlSection& section) {
  const std::vector<std::string> only = only_stages(section);
  bool picked = false;
  section("picked", picked, "");
  std::vector<StudyVariant> variants(1);
  variants[0].name = "default";
  for (const auto& stage : describe_stages()) {
    if (!only.empty() && std::find(only.begin(), only.end(), stage.name) == only.end()) continue;
    for (const auto& entry : stage.variants) {
      if (entry.name == stage.default_variant || (!picked && !entry.picks.empty())) continue;
      StudyVariant variant;
      variant.name = stage.name + "=" + entry.name;
      choose_variant(variant.options, stage.name, entry.name);
      variants.push_back(variant);
    }
  }
  return variants;
}

// Those that come with the program, by their names.
std::vector<StudyVariant> all_presets() {
  std::vector<StudyVariant> variants;
  for (const auto& name : preset_names()) {
    StudyVariant variant;
    variant.name = name;
    take_preset(variant, read_preset(name));
    variants.push_back(variant);
  }
  return variants;
}

// A command runs instead of the pipeline, which then has nothing to be told.
void take_foreign(TomlSection& section, const std::optional<ForeignPipeline>& foreign,
                  std::vector<StudyVariant>& variants) {
  if (!foreign) return;
  for (auto& variant : variants) {
    if (variant.name == "default") section.fail("name", "is missing; expected a name for what the command runs");
    if (!variant.options.variants.empty() || !variant.options.values.empty() || !variant.oracles.empty())
      section.fail("command",
                   "found it beside a preset, stages, set or oracle; expected it without them (sensor, rig, scan, "
                   "scale and set.sensor are the capture's)");
    variant.foreign = foreign;
  }
}

}  // namespace

std::vector<StudyVariant> read_study_variants(TomlSection& section, std::string name) {
  bool each_alone = false;
  section("name", name, {}, "");
  section("one_at_a_time", each_alone, "");
  if (each_alone) return one_at_a_time(section);
  bool every_preset = false;
  section("every_preset", every_preset, "");
  if (every_preset) return all_presets();
  bool every_oracle = false;
  section("every_oracle", every_oracle, "");
  if (every_oracle) return all_oracles();
  const std::optional<ForeignPipeline> foreign = read_foreign_pipeline(section);
  std::vector<Axis> axes;
  add_preset_axis(section, axes);
  add_stage_axes(section, axes);
  add_sensor_axis(section, axes);
  add_parameter_axes(section, axes);
  add_file_axis(section, "rig", &StudyVariant::rig, axes);
  add_file_axis(section, "scan", &StudyVariant::scan, axes);
  add_scale_axis(section, axes);
  add_oracle_axis(section, axes);
  std::size_t count = 1;
  for (const auto& axis : axes)
    if ((count *= axis.size()) > kMostVariants)
      section.fail("", fmt::format("found more than {} combinations; expected a smaller grid", kMostVariants));
  std::vector<StudyVariant> variants;
  for (std::size_t place = 0; place < count; ++place) variants.push_back(combination(axes, name, place));
  take_foreign(section, foreign, variants);
  return variants;
}

}  // namespace dressform
