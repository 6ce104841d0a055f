#pragma once
#include <map>
#include <string>

#include "scenes/serialize.h"

namespace dressform {

// Results of stages that are there already, by the stage's label ("fuse_naked", "registration"): these stages are not
// run, and what follows is given these results in place of theirs. Where they come from is no business of the pipeline.
class GivenArtifacts {
 public:
  template <class StageType>
  void give(const std::string& label, const typename StageType::Output& result) {
    bytes_[label] = to_bytes(result);
  }
  // The serialized result; null where the stage has to run.
  const std::string* find(const std::string& label) const {
    const auto found = bytes_.find(label);
    return found == bytes_.end() ? nullptr : &found->second;
  }

 private:
  std::map<std::string, std::string> bytes_;
};

}  // namespace dressform
