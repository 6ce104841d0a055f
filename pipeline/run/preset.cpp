#include "pipeline/run/preset.h"

#include <algorithm>

#include "pipeline/reconstruct.h"
#include "scenes/toml_section.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// The folder of presets that belongs to the running program; empty where there is none.
fs::path presets_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* place : {"../share/dressform/presets", "../../pipeline/presets"})
    if (const fs::path folder = (program / place).lexically_normal(); fs::is_directory(folder)) return folder;
  return {};
}

std::vector<std::string> names_of(const StageDescription& stage) {
  std::vector<std::string> names;
  for (const auto& variant : stage.variants) names.push_back(variant.name);
  return names;
}

FieldValues read_values(TomlSection& section, const StageDescription& stage, const std::string& variant) {
  FieldValues values;
  for (const auto& described : stage.variants) {
    if (described.name != variant) continue;
    for (const auto& field : described.fields)
      if (const auto* node = section.find(field.name.c_str()))
        values[field.name] = checked_value(*node, stage.name + "." + field.name, field);
  }
  return values;
}

}  // namespace

bool is_preset_file(const std::string& name_or_file) {
  return name_or_file.find('/') != name_or_file.npos || fs::path(name_or_file).extension() == ".toml";
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  const fs::path folder = presets_folder();
  if (folder.empty()) return names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Preset read_preset(const std::string& name_or_file) {
  fs::path file = name_or_file;
  if (!is_preset_file(name_or_file)) {
    const auto names = preset_names();
    std::string known;
    for (const auto& name : names) known += (known.empty() ? "" : ", ") + name;
    if (std::find(names.begin(), names.end(), name_or_file) == names.end())
      throw InputError("--preset " + name_or_file, "no such preset; expected " + known +
                                                       (known.empty() ? "" : ", or ") + "the path of a TOML file");
    file = presets_folder() / (name_or_file + ".toml");
  }
  TomlFiles files;
  TomlSection section(files, files.open(file, file.filename().string(), ""), "");
  Preset preset;
  preset.name = file.stem().string();
  section("description", preset.description, {}, "");
  const auto stages = describe_stages();
  std::map<std::string, std::string> chosen;
  for (const auto& stage : stages) chosen[stage.name] = stage.default_variant;
  section.child("variants", [&](TomlSection& variants) {
    for (const auto& stage : stages) {
      if (!variants.has(stage.name.c_str())) continue;
      variants(stage.name.c_str(), chosen[stage.name], names_of(stage), "");
      preset.variants[stage.name] = chosen[stage.name];
    }
  });
  section.child("set", [&](TomlSection& set) {
    for (const auto& stage : stages)
      set.child(stage.name.c_str(), [&](TomlSection& parameters) {
        preset.values[stage.name] = read_values(parameters, stage, chosen[stage.name]);
      });
  });
  section.finish();
  return preset;
}

}  // namespace dressform
