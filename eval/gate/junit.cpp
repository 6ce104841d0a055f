#include "eval/gate/junit.h"

#include <pugixml.hpp>
#include <sstream>

#include "scenes/file_bytes.h"

namespace dressform {
namespace {

pugi::xml_node add_test(pugi::xml_node suite, const std::string& case_name, const std::string& name) {
  auto test = suite.append_child("testcase");
  test.append_attribute("classname") = ("gate." + case_name).c_str();
  test.append_attribute("name") = name.c_str();
  return test;
}

void complain(pugi::xml_node test, const char* kind, const std::string& type, const std::string& message) {
  auto node = test.append_child(kind);
  node.append_attribute("type") = type.c_str();
  node.append_attribute("message") = message.c_str();
}

void add_suite(pugi::xml_node root, const CheckedCase& checked) {
  auto suite = root.append_child("testsuite");
  suite.append_attribute("name") = ("gate." + checked.name).c_str();
  const bool lost = !checked.error.empty();
  suite.append_attribute("tests") = static_cast<unsigned>(lost ? 1 : checked.result.items.size() + 1);
  suite.append_attribute("failures") = static_cast<unsigned>(lost ? 0 : checked.result.findings.size());
  suite.append_attribute("errors") = lost ? 1 : 0;
  if (lost) {
    complain(add_test(suite, checked.name, "run"), "error", "no result", checked.error);
    return;
  }
  auto bytes = add_test(suite, checked.name, "bytes");
  bytes.append_child("system-out").text() = bytes_text(checked.result.bytes).c_str();
  for (const auto& item : checked.result.items) {
    auto test = add_test(suite, checked.name, item.stage + "." + item.name);
    if (is_failure(item.verdict))
      complain(test, "failure", verdict_word(item.verdict), item.message);
    else if (!item.message.empty())
      test.append_child("system-out").text() = (std::string(verdict_word(item.verdict)) + ": " + item.message).c_str();
  }
}

}  // namespace

std::string junit_xml(const std::vector<CheckedCase>& cases) {
  pugi::xml_document document;
  auto root = document.append_child("testsuites");
  root.append_attribute("name") = "gate";
  for (const auto& checked : cases) add_suite(root, checked);
  std::ostringstream text;
  document.save(text, " ");
  return text.str();
}

void write_junit(const std::filesystem::path& file, const std::vector<CheckedCase>& cases) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_file_atomically(file, junit_xml(cases));
}

}  // namespace dressform
