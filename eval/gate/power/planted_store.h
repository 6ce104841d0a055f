#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/reconstruct.h"

namespace dressform {

// A store in a new folder that has all artifacts of a run, as links into its store, but one: that of the stage labelled
// `label` has other bytes under the same key. Who runs the same thing with it finds that result, and makes anew only
// what follows from it. The run's own store is left as it is. `label` empty: links alone. Throws std::logic_error for a
// label that the run does not have, std::runtime_error when an artifact is no longer there.
void plant_artifact(const std::filesystem::path& store, const std::vector<StageRecord>& records,
                    const std::string& label, const std::function<std::string(const std::string&)>& edit,
                    const std::filesystem::path& planted);

}  // namespace dressform
