#pragma once
#include <string>
#include <vector>

#include "pipeline/reconstruct.h"
#include "scenes/toml_section.h"

namespace dressform {

// What a node of a TOML file names, or InputError with file, line and column that lists what is known.
const StageDescription& stage_at(const toml::node& node, const std::string& name);
const StageDescription::VariantDescription& variant_at(const toml::node& node, const StageDescription& stage,
                                                       const std::string& name);
const FieldInfo& field_at(const toml::node& node, const std::string& owner, const std::vector<FieldInfo>& fields,
                          const std::string& name);

}  // namespace dressform
