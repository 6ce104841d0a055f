#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/registry.h"

namespace dressform {

// One measured number. Metric names carry unit and version: "top/f_10mm@1", "k2/rotation_deg@1".
struct ScoreRow {
  std::string stage;  // which stage it judges: "registration", "surface", "open", "texture", "fit", "correct", ...
  std::string metric;
  std::string unit;           // "mm", "deg", "1", ...
  double value = 0;           // NaN when status is not "ok"
  std::string status = "ok";  // "ok", "failed" (the pipeline gave nothing), "absent" (the truth has no such thing)
  long n_samples = 0;
};

struct Scores {
  std::string scene;
  std::string variant;  // "default", or the chosen variants and parameters: "surface=rbf_carr fuse.voxel_m=0.003"
  Seed seed = 0;
  std::vector<ScoreRow> rows;  // sorted by stage order and metric as evaluate() gives them

  const ScoreRow* find(const std::string& stage, const std::string& metric) const;
};

// scores.json: no times, no paths; the same scores give the same bytes. NaN is written as null.
std::string scores_to_json(const Scores& scores);
Scores scores_from_json(const std::filesystem::path& file);  // InputError naming file and field

// scores.csv: run_id,scene,variant,stage,seed,metric,unit,value,status,n_samples.
std::string scores_to_csv(const Scores& scores, const std::string& run_id);

}  // namespace dressform
