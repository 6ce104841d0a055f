#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "pipeline/run/preset.h"
#include "scenes/import/import.h"
#include "synthetic/sensors/sensor_model.h"

namespace dressform {
namespace {

void print_field(const FieldInfo& field) {
  std::string range;
  if (std::holds_alternative<int>(field.value) || std::holds_alternative<double>(field.value))
    range = to_text(field.minimum) + " to " + to_text(field.maximum);
  for (const auto& choice : field.choices) range += (range.empty() ? "" : "|") + choice;
  const std::string unit = field.unit.empty() ? "" : " " + field.unit;
  fmt::print("      {:<26} {:<10} {}{}\n", field.name, to_text(field.value) + unit,
             range.empty() ? "" : "[" + range + "] ", field.doc);
}

void print_variant(const std::string& name, bool is_default, const std::vector<FieldInfo>& fields,
                   const std::vector<std::string>& picks = {}) {
  fmt::print("  {}{}\n", name, is_default ? "  (default)" : "");
  if (!picks.empty()) fmt::print("      needs what a person picked: {}\n", fmt::join(picks, ", "));
  for (const auto& field : fields) print_field(field);
}

// Whether this registry, which is no stage, was asked for.
template <class Family>
bool print_family(const std::string& only) {
  if (!only.empty() && only != Family::name()) return false;
  fmt::print("{}\n", Family::name());
  for (const auto& name : Family::names())
    print_variant(name, name == Family::default_variant(), Family::at(name).fields);
  return true;
}

int print_variants(const std::string& only) {
  bool found = print_family<Importer>(only);
  found = print_family<SensorModel>(only) || found;
  for (const auto& stage : describe_stages()) {
    if (!only.empty() && only != stage.name) continue;
    found = true;
    fmt::print("{}\n", stage.name);
    for (const auto& variant : stage.variants)
      print_variant(variant.name, variant.name == stage.default_variant, variant.fields, variant.picks);
  }
  if (!found)
    throw InputError("stage " + only, "not known; expected import, sensor or a stage that `dressform variants` lists");
  return kSuccess;
}

int print_presets() {
  for (const auto& name : preset_names()) {
    const Preset preset = read_preset(name);
    fmt::print("{}: {}\n", name, preset.description);
    for (const auto& [stage, variant] : preset.variants) fmt::print("  --variant {}={}\n", stage, variant);
    for (const auto& [stage, values] : preset.values)
      for (const auto& [parameter, value] : values) fmt::print("  --set {}.{}={}\n", stage, parameter, to_text(value));
  }
  return kSuccess;
}

Command add_variants_command(CLI::App& app) {
  auto stage = std::make_shared<std::string>();
  auto presets = std::make_shared<bool>(false);
  auto* command = app.add_subcommand("variants", "List the stages, their variants and parameters");
  command->add_option("stage", *stage, "only this stage");
  command->add_flag("--presets", *presets, "instead: the presets, and what they stand for");
  command->footer("Example:\n  dressform variants registration\n  dressform variants --presets");
  return [stage, presets] { return *presets ? print_presets() : print_variants(*stage); };
}

const RegisteredCommand registered_variants{100, add_variants_command};

}  // namespace
}  // namespace dressform
