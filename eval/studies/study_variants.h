#pragma once
#include <vector>

#include "eval/studies/study.h"
#include "scenes/toml_section.h"

namespace dressform {

// The variants that one [[variant]] table stands for: several where a value is an array (all combinations), or where
// one_at_a_time asks for every registered variant of every stage beside the default, or every_preset for all presets.
// `name`: what they are called where the table does not say.
std::vector<StudyVariant> read_study_variants(TomlSection& section, std::string name = {});

}  // namespace dressform
