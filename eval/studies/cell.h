#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/score/scores.h"
#include "eval/studies/signature.h"

namespace dressform {

// What one variant gave on one scene with one seed. The same inputs give the same bytes: no times, no paths.
struct CellResult {
  std::string id;  // hash of all that was asked
  Signature signature;
  std::string scene;
  Seed seed = 0;
  double scale = 1;
  bool failed = false;                // the run ended before it had scores
  std::string reason;                 // why; one line
  std::vector<std::string> problems;  // what stages did not manage, of a run that ended
  std::vector<ScoreRow> scores;
};

// What it cost: never the same twice, so kept apart.
struct CellCost {
  double capture_seconds = 0;
  std::vector<std::pair<std::string, double>> stage_seconds;  // by stage, in the pipeline's order
  double peak_memory_mb = 0;
  double pipeline_seconds() const;
};

struct MadeCell {
  CellResult result;
  CellCost cost;
};

std::string cell_json(const CellResult& cell);
// Throws InputError naming the file where it is damaged, or holds another cell than its name says.
CellResult read_cell(const std::filesystem::path& file);

std::string cost_json(const CellCost& cost);
std::optional<CellCost> read_cost(const std::filesystem::path& file);  // absent where there is none, or it is damaged

}  // namespace dressform
