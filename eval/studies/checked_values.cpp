#include "eval/studies/checked_values.h"

#include <fmt/format.h>

namespace dressform {

const StageDescription& stage_at(const toml::node& node, const std::string& name) {
  static const std::vector<StageDescription> stages = describe_stages();
  std::string known;
  for (const auto& stage : stages) {
    if (stage.name == name) return stage;
    known += (known.empty() ? "" : ", ") + stage.name;
  }
  throw InputError(where_of(node), fmt::format("found the stage \"{}\"; expected one of {}", name, known));
}

const StageDescription::VariantDescription& variant_at(const toml::node& node, const StageDescription& stage,
                                                       const std::string& name) {
  std::string known;
  for (const auto& variant : stage.variants) {
    if (variant.name == name) return variant;
    known += (known.empty() ? "" : ", ") + variant.name;
  }
  throw InputError(where_of(node), fmt::format("{}: found \"{}\"; expected one of {}", stage.name, name, known));
}

const FieldInfo& field_at(const toml::node& node, const std::string& owner, const std::vector<FieldInfo>& fields,
                          const std::string& name) {
  std::string known;
  for (const auto& field : fields) {
    if (field.name == name) return field;
    known += (known.empty() ? "" : ", ") + field.name;
  }
  throw InputError(where_of(node), fmt::format("{} has no parameter \"{}\"; known are {}", owner, name,
                                               known.empty() ? "none" : known));
}

}  // namespace dressform
