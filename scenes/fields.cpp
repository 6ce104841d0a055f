#include "scenes/fields.h"

#include <algorithm>
#include <charconv>

#include "scenes/error.h"
#include "scenes/length_units.h"

namespace dressform {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

template <class T>
T parse_number(const std::string& where, const std::string& text, const char* kind) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError(where, "found \"" + text + "\"; expected " + kind);
  return value;
}

template <class T>
T in_range(const std::string& where, T value, T minimum, T maximum, const char* unit) {
  if (value >= minimum && value <= maximum) return value;
  throw InputError(where, "found " + to_text(value) + "; expected " + to_text(minimum) + " to " + to_text(maximum) +
                              (*unit ? std::string(" ") + unit : "") +
                              likely_unit(static_cast<double>(value), static_cast<double>(minimum),
                                          static_cast<double>(maximum), unit));
}

}  // namespace

std::string likely_unit(double value, double minimum, double maximum, const std::string& unit) {
  if (unit != "m" || (value >= minimum && value <= maximum)) return "";
  for (const char* name : {"cm", "mm"}) {
    const LengthUnit& meant = length_unit(name);
    const double metres = value * meant.metres;
    if (metres >= minimum && metres <= maximum && metres != 0) return std::string("; looks like ") + meant.plural;
  }
  return "";
}

std::string to_text(const FieldValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<int>(&value)) return std::to_string(*whole);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  char buffer[64];
  const double number = std::get<double>(value);
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, number);  // shortest text that reads back the same
  return std::string(buffer, result.ptr);
}

FieldValue parse_field(const std::string& where, const std::string& text, const FieldValue& like) {
  if (std::holds_alternative<bool>(like)) {
    if (text == "true") return true;
    if (text == "false") return false;
    throw InputError(where, "found \"" + text + "\"; expected true or false");
  }
  if (std::holds_alternative<int>(like)) return parse_number<int>(where, text, "a whole number");
  if (std::holds_alternative<double>(like)) return parse_number<double>(where, text, "a number");
  return text;
}

void FieldLister::operator()(const char* name, double& value, double minimum, double maximum, const char* unit,
                             const char* doc) {
  fields.push_back({name, value, minimum, maximum, {}, unit, doc});
}
void FieldLister::operator()(const char* name, int& value, int minimum, int maximum, const char* unit,
                             const char* doc) {
  fields.push_back({name, value, minimum, maximum, {}, unit, doc});
}
void FieldLister::operator()(const char* name, bool& value, const char* doc) {
  fields.push_back({name, value, false, true, {}, "", doc});
}
void FieldLister::operator()(const char* name, std::string& value, const std::vector<std::string>& choices,
                             const char* doc) {
  fields.push_back({name, value, {}, {}, choices, "", doc});
}

const FieldValue* FieldAssigner::find(const char* name) {
  known_.push_back(name);
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

void FieldAssigner::operator()(const char* name, double& value, double minimum, double maximum, const char* unit,
                               const char*) {
  const FieldValue* given = find(name);
  if (!given) return;
  const std::string where = where_ + "." + name;
  double number = 0;
  if (const auto* real = std::get_if<double>(given))
    number = *real;
  else if (const auto* whole = std::get_if<int>(given))
    number = *whole;
  else if (const auto* text = std::get_if<std::string>(given))
    number = parse_number<double>(where, *text, "a number");
  else
    throw InputError(where, "found " + to_text(*given) + "; expected a number");
  value = in_range(where, number, minimum, maximum, unit);
}

void FieldAssigner::operator()(const char* name, int& value, int minimum, int maximum, const char* unit, const char*) {
  const FieldValue* given = find(name);
  if (!given) return;
  const std::string where = where_ + "." + name;
  int number = 0;
  if (const auto* whole = std::get_if<int>(given))
    number = *whole;
  else if (const auto* text = std::get_if<std::string>(given))
    number = parse_number<int>(where, *text, "a whole number");
  else
    throw InputError(where, "found " + to_text(*given) + "; expected a whole number");
  value = in_range(where, number, minimum, maximum, unit);
}

void FieldAssigner::operator()(const char* name, bool& value, const char*) {
  const FieldValue* given = find(name);
  if (!given) return;
  if (const auto* flag = std::get_if<bool>(given))
    value = *flag;
  else
    value = std::get<bool>(parse_field(where_ + "." + name, to_text(*given), FieldValue(false)));
}

void FieldAssigner::operator()(const char* name, std::string& value, const std::vector<std::string>& choices,
                               const char*) {
  const FieldValue* given = find(name);
  if (!given) return;
  const std::string text = to_text(*given);
  if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end())
    throw InputError(where_ + "." + name, "found \"" + text + "\"; expected one of " + joined(choices));
  value = text;
}

void FieldAssigner::finish() const {
  for (const auto& [name, value] : values_)
    if (std::find(known_.begin(), known_.end(), name) == known_.end())
      throw InputError(where_ + "." + name,
                       "unknown parameter; known are " + (known_.empty() ? std::string("none") : joined(known_)));
}

}  // namespace dressform
