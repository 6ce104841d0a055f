#pragma once
#include <string>
#include <vector>

#include "eval/studies/study_results.h"
#include "render/charts/row_chart.h"

namespace dressform {

// Paired differences by one metric: a row a variant, a dot a scene, the mean with its interval; the margin shaded about
// zero.
RowChart forest_chart(const StudyResults& results, const std::vector<VariantSummary>& summaries, std::size_t metric);
std::string forest_svg(const StudyResults& results, const std::vector<VariantSummary>& summaries, std::size_t metric);

}  // namespace dressform
