#include "eval/oracle/oracle.h"

#include <algorithm>
#include <map>

#include "scenes/error.h"

namespace dressform {
namespace {

std::map<std::string, Oracle::Give>& registered_oracles() {
  static std::map<std::string, Oracle::Give> oracles;
  return oracles;
}

// Labels of stages as reconstruct.cpp runs them, where they are not the stage's name alone.
std::vector<std::string> labels_in_order() {
  std::vector<std::string> labels;
  for (const auto& stage : describe_stages()) {
    if (stage.name != Fuse::name()) {
      labels.push_back(stage.name);
      continue;
    }
    labels.push_back("fuse_naked");
    labels.push_back("fuse_user");  // it depends on the cameras alone
  }
  return labels;
}

}  // namespace

Oracle::Oracle(const char* label, Give give) { registered_oracles().emplace(label, give); }

std::vector<std::string> oracle_labels() {
  std::vector<std::string> labels;
  for (const auto& label : labels_in_order())
    if (registered_oracles().count(label)) labels.push_back(label);
  return labels;
}

void check_oracle(const std::string& where, const std::string& label) {
  if (registered_oracles().count(label)) return;
  std::string known;
  for (const auto& each : oracle_labels()) known += (known.empty() ? "" : ", ") + each;
  throw InputError(where, "found \"" + label + "\", which truth cannot stand in for; expected one of " + known);
}

void give_truth(const std::string& label, const OracleInput& input, GivenArtifacts& given) {
  check_oracle("oracle", label);
  registered_oracles().at(label)(input, given);
}

Reconstruction reconstruct_with_truth(const SessionSource& source, const ReconstructionOptions& options,
                                      ArtifactStore& store, const StageProgress& progress,
                                      const std::vector<std::string>& labels, const GroundTruth& truth) {
  for (const auto& label : labels) check_oracle("oracle", label);
  GivenArtifacts given;
  Reconstruction made = reconstruct(source, options, store, progress);
  for (const auto& label : oracle_labels()) {
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) continue;
    give_truth(label, {made, source.session.get(), truth}, given);
    made = reconstruct(source, options, store, progress, given);
  }
  return made;
}

}  // namespace dressform
