#pragma once
#include <string>
#include <vector>

#include "eval/studies/study_results.h"

namespace dressform {

// Where a changed end score comes from. Between pipelines A and B, the stages in which they differ are swapped one at a
// time, in both orders: from the first stage on, and from the last one back. A stage's part is the change of the score
// when it is swapped. The two orders need not agree, as stages lean on one another; each adds up to the whole change.
struct AttributionStudy {
  std::vector<std::string> stages;     // in which A and B differ, in the pipeline's order
  std::vector<StudyVariant> variants;  // "A", "B", "first <k> of B", "last <k> of B" with k from 1 to stages - 1
};

// Throws InputError where A and B do not differ.
AttributionStudy attribution_of(const ReconstructionOptions& a, const ReconstructionOptions& b);

// One metric over the scenes on which every variant gave a number.
struct Attribution {
  struct Part {
    std::string stage;
    double from_first = 0, from_last = 0;                     // means over the scenes, in the metric's unit
    std::vector<double> from_first_scenes, from_last_scenes;  // scene by scene
  };
  const StudyMetric* metric = nullptr;
  std::vector<std::string> scenes;  // those that are complete
  std::size_t planned_scenes = 0;
  double a = 0, b = 0;  // means
  std::vector<Part> parts;
};

// Of a study that was planned with the variants of `attribution_of`: one for each of its metrics, which must outlive
// the result. Throws InputError where the study has other variants.
std::vector<Attribution> attributions(const StudyResults& results, const std::vector<std::string>& stages);

// A table for each metric; and metric,stage,order,scene,part,unit lines.
std::string attribution_markdown(const StudyResults& results, const std::vector<Attribution>& attributions);
std::string attribution_csv(const std::vector<Attribution>& attributions);

}  // namespace dressform
