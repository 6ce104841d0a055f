#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "scenes/registry.h"

namespace dressform {

// What a run.json says of the scores beside it.
struct RunFacts {
  std::optional<std::string> scene, variant;
  std::optional<Seed> seed;
  std::optional<double> scale;    // of the capture's cameras
  std::filesystem::path session;  // empty: not said
  std::string commit;             // of the program; empty: not said
};

// Reads `run`/run.json; facts that it does not have, or all of them where there is no such file, are absent. Throws
// InputError naming the file where it is no JSON object, or a fact is of another kind than a run writes.
RunFacts read_run_facts(const std::filesystem::path& run);

}  // namespace dressform
