#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

namespace dressform {

// Visitor of scenes/fields.h that makes fields options of a command: --sensor-model of sensor_model, with the range or
// the words that the field has.
class OptionFields {
 public:
  explicit OptionFields(CLI::App& command) : command_(command) {}
  void operator()(const char* name, std::string& value, const std::vector<std::string>& choices, const char* doc) {
    auto* option = command_.add_option(option_name(name), value, doc);
    if (!choices.empty()) option->check(CLI::IsMember(choices));
  }
  void operator()(const char* name, double& value, double minimum, double maximum, const char*, const char* doc) {
    command_.add_option(option_name(name), value, doc)->check(CLI::Range(minimum, maximum));
  }
  void operator()(const char* name, int& value, int minimum, int maximum, const char*, const char* doc) {
    command_.add_option(option_name(name), value, doc)->check(CLI::Range(minimum, maximum));
  }
  void operator()(const char* name, bool& value, const char* doc) { command_.add_flag(option_name(name), value, doc); }

 private:
  static std::string option_name(std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    return "--" + name;
  }
  CLI::App& command_;
};

}  // namespace dressform
