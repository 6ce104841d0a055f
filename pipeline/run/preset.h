#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scenes/fields.h"

namespace dressform {

// Variants and parameters by one name: a TOML file with `description`, [variants] (stage = "variant") and [set]
// (stage.parameter = value).
struct Preset {
  std::string name, description;
  std::map<std::string, std::string> variants;
  std::map<std::string, FieldValues> values;
};

// Whether a preset is asked for by its file: what ends in .toml or holds a slash. Anything else is a name.
bool is_preset_file(const std::string& name_or_file);

// A preset that comes with the program, by name, or a file of one's own. Throws
// InputError: a name that is not known (with those that are); in the file, with line and column, a stage, variant or
// parameter that is not known, or a value out of range.
Preset read_preset(const std::string& name_or_file);

// Those that come with the program, sorted: the files of share/dressform/presets beside the installed program's
// folder, or of pipeline/presets where it runs in its build folder.
std::vector<std::string> preset_names();

}  // namespace dressform
