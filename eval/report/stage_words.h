#pragma once
#include <string>

#include "pipeline/reconstruct.h"

namespace dressform {

// What a stage says of itself, with no truth: a sentence or two with numbers, for the report. `label` is that of its
// record, or "capture"; empty where it has nothing to say.
std::string stage_words(const Reconstruction& made, const std::string& label);

}  // namespace dressform
