#include "scenes/toml_value.h"

#include <algorithm>
#include <sstream>

namespace dressform {
namespace {

std::string type_name(const toml::node& node) {
  std::ostringstream text;
  text << node.type();
  return text.str();
}

// Negated so that NaN fails as well.
template <class T>
T in_range(const toml::node& node, const std::string& name, T value, T minimum, T maximum, const std::string& unit) {
  if (value >= minimum && value <= maximum) return value;
  throw InputError(
      where_of(node),
      name + ": found " + to_text(FieldValue(value)) + "; expected " + to_text(FieldValue(minimum)) + " to " +
          to_text(FieldValue(maximum)) + (unit.empty() ? "" : " ") + unit +
          likely_unit(static_cast<double>(value), static_cast<double>(minimum), static_cast<double>(maximum), unit));
}

}  // namespace

std::string where_of(const toml::node& node) {
  const auto& source = node.source();
  return (source.path ? *source.path : std::string("scene")) + ":" + std::to_string(source.begin.line) + ":" +
         std::to_string(source.begin.column);
}

void wrong_value(const toml::node& node, const std::string& name, const std::string& expected) {
  throw InputError(where_of(node), name + ": found " + type_name(node) + "; expected " + expected);
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "none" : text;
}

double number_in(const toml::node& node, const std::string& name, double minimum, double maximum,
                 const std::string& unit) {
  if (!node.is_integer() && !node.is_floating_point()) wrong_value(node, name, "a number");
  const double number =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  return in_range(node, name, number, minimum, maximum, unit);
}

int whole_number_in(const toml::node& node, const std::string& name, int minimum, int maximum,
                    const std::string& unit) {
  if (!node.is_integer()) wrong_value(node, name, "a whole number");
  // Clamped first, so that a number beyond int is out of range and not wrapped.
  const auto whole = std::clamp<std::int64_t>(node.as_integer()->get(), INT32_MIN, INT32_MAX);
  return in_range(node, name, static_cast<int>(whole), minimum, maximum, unit);
}

bool flag_in(const toml::node& node, const std::string& name) {
  if (!node.is_boolean()) wrong_value(node, name, "true or false");
  return node.as_boolean()->get();
}

std::string word_in(const toml::node& node, const std::string& name, const std::vector<std::string>& choices) {
  if (!node.is_string()) wrong_value(node, name, "text");
  const std::string word = node.as_string()->get();
  if (!choices.empty() && std::find(choices.begin(), choices.end(), word) == choices.end())
    throw InputError(where_of(node), name + ": found \"" + word + "\"; expected one of " + listed(choices));
  return word;
}

FieldValue checked_value(const toml::node& node, const std::string& name, const FieldInfo& field) {
  if (std::holds_alternative<bool>(field.value)) return flag_in(node, name);
  if (std::holds_alternative<std::string>(field.value)) return word_in(node, name, field.choices);
  if (std::holds_alternative<int>(field.value))
    return whole_number_in(node, name, std::get<int>(field.minimum), std::get<int>(field.maximum), field.unit);
  return number_in(node, name, std::get<double>(field.minimum), std::get<double>(field.maximum), field.unit);
}

}  // namespace dressform
