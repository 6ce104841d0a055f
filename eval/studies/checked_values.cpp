#include "eval/studies/checked_values.h"

#include <fmt/format.h>

#include <algorithm>

namespace dressform {
namespace {

template <class T>
T ranged(const toml::node& node, const std::string& name, const FieldInfo& field, T value) {
  const T low = std::get<T>(field.minimum), high = std::get<T>(field.maximum);
  if (value >= low && value <= high) return value;
  throw InputError(where_of(node), fmt::format("{}: found {}; expected {} to {} {}", name, to_text(FieldValue(value)),
                                               to_text(field.minimum), to_text(field.maximum), field.unit));
}

std::string worded(const std::string& name, const toml::node& node, const FieldInfo& field) {
  if (!node.is_string()) wrong_value(node, name, "text");
  const std::string text = node.as_string()->get();
  const auto& choices = field.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end())
    throw InputError(where_of(node),
                     fmt::format("{}: found \"{}\"; expected one of {}", name, text, fmt::join(choices, ", ")));
  return text;
}

}  // namespace

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

[[noreturn]] void wrong_value(const toml::node& node, const std::string& name, const std::string& expected) {
  throw InputError(where_of(node), name + ": found another kind of value; expected " + expected);
}

FieldValue checked_value(const toml::node& node, const std::string& name, const FieldInfo& field) {
  if (std::holds_alternative<bool>(field.value)) {
    if (!node.is_boolean()) wrong_value(node, name, "true or false");
    return node.as_boolean()->get();
  }
  if (std::holds_alternative<std::string>(field.value)) return worded(name, node, field);
  if (std::holds_alternative<int>(field.value)) {
    if (!node.is_integer()) wrong_value(node, name, "a whole number");
    const auto whole = std::clamp<std::int64_t>(node.as_integer()->get(), INT32_MIN, INT32_MAX);
    return ranged(node, name, field, static_cast<int>(whole));
  }
  if (node.is_integer()) return ranged(node, name, field, static_cast<double>(node.as_integer()->get()));
  if (!node.is_floating_point()) wrong_value(node, name, "a number");
  return ranged(node, name, field, node.as_floating_point()->get());
}

}  // namespace dressform
