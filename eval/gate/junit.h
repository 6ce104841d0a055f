#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "eval/gate/gate.h"

namespace dressform {

// What a check said about one case: a result, or why there is none (a reference that is missing or corrupt, a run that
// crashed).
struct CheckedCase {
  std::string name;
  GateResult result;
  std::string error;  // empty: there is a result
};

// JUnit's XML, as CI services read it: one test a number, picture and target, classname "gate.CASE", name
// "STAGE.METRIC", and one for the bytes. Changed bytes alone are no failure: they stand in the test's output.
std::string junit_xml(const std::vector<CheckedCase>& cases);

// Writes it atomically. Throws InputError naming the file when it cannot be written.
void write_junit(const std::filesystem::path& file, const std::vector<CheckedCase>& cases);

}  // namespace dressform
