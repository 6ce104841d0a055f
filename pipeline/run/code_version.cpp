#include "pipeline/run/artifact_store.h"

namespace dressform {

// A file of its own, and never one of a group: it is compiled again after every edit and every commit.
std::string code_version(const std::string& stage) {
  static const std::map<std::string, std::string> versions = {
#include "code_versions.inc"
  };
  return versions.at(stage);
}

}  // namespace dressform
