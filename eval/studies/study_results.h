#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/studies/cell.h"
#include "eval/studies/comparison.h"
#include "eval/studies/plan.h"

namespace dressform {

// The cells of a study that are there, whoever made them and in whatever order.
struct StudyResults {
  StudyPlan plan;
  std::vector<PlannedCell> planned;  // each id once for every variant that asks for it
  std::map<std::string, CellResult> cells;
  std::map<std::string, CellCost> costs;
  Signature signature;  // of all of them

  // Of one variant on one scene; null where it is not there yet.
  std::vector<const CellResult*> cells_of(std::size_t variant, std::size_t scene) const;
  // Seeds averaged; failed where one of them is, absent where one of them is, or not there yet.
  Outcome outcome(std::size_t variant, std::size_t scene, const StudyMetric& metric) const;
  // Mean over the variant's cells; absent where none has a record.
  std::optional<double> pipeline_seconds(std::size_t variant) const;
};

// Throws InputError where the folder holds no study, a cell is damaged, no cell is there, or cells have different
// signatures: such numbers are not compared.
StudyResults read_results(const std::filesystem::path& folder);

// A variant with everything that it is told by, in the order of the study's metrics.
struct VariantSummary {
  std::size_t variant = 0;
  std::vector<Comparison> comparisons;
  int cells = 0, failed = 0;
  std::optional<double> seconds;
};

// All variants against the baseline, Holm over the primary metrics of each. The baseline itself comes first, compared
// with itself; the others from better to worse by the first primary metric.
std::vector<VariantSummary> compare_variants(const StudyResults& results);

// Of the targets that hold at the cells' scale: in how many scenes all were met, and how many in all.
struct TargetsMet {
  int scenes = 0, all_met = 0, asked = 0, met = 0;
};
// Over the scenes of a stratum; empty: over all.
TargetsMet count_targets(const StudyResults& results, std::size_t variant, const std::string& stratum);

}  // namespace dressform
