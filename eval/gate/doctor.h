#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dressform {

// Something about the references that makes them gate less than they seem to.
struct Complaint {
  std::string where;  // "group1", "nuisance.json"
  std::string what;
  bool grave = false;  // missing, corrupt or obsolete: a check would end with exit code 3, or compare nothing
};

// Looks at all references without running anything: what is missing, corrupt or stale; known misses and numbers that no
// metric declares; pictures that cannot be told apart; files that nobody reads; bytes that are not kept; numbers that
// crept; and how well nuisance is known. Grave ones first.
std::vector<Complaint> examine_goldens(const std::filesystem::path& golden);

}  // namespace dressform
