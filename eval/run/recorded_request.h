#pragma once
#include <filesystem>

#include "eval/run/end_to_end.h"

namespace dressform {

// The request that made a run, from its run.json. Throws InputError naming the file where it can't be read.
EndToEndRequest recorded_request(const std::filesystem::path& run);

}  // namespace dressform
