#pragma once
#include <string>
#include <vector>

#include "eval/studies/study_results.h"

namespace dressform {

// Paired differences by one metric as SVG: a row a variant, a dot a scene, the mean with its interval; the margin
// shaded about zero.
std::string forest_svg(const StudyResults& results, const std::vector<VariantSummary>& summaries, std::size_t metric);

}  // namespace dressform
