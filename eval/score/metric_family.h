#pragma once
#include <optional>
#include <string>
#include <vector>

#include "eval/score/evaluate.h"
#include "eval/score/metric.h"

namespace dressform {

// A run with the truth it is judged by.
struct Judged {
  const RunOutputs& outputs;
  const GroundTruth& truth;
  std::optional<Isometry3d> world_from_model;  // through the gauge sensor alone
  // What a row is that needs the world frame where there is none: "failed", the gauge sensor was not registered;
  // "absent", the truth does not say where it stood.
  std::string status_without_world = "failed";
  std::string gauge_sensor;
  EvaluateOptions options;
};

// The garments that rows are made of: those of the truth; where it has none at all, those of the run (their rows are
// absent). Sorted.
std::vector<std::string> judged_slots(const Judged& run);

class MetricFamily;

// Collects the rows of one family. Metrics are called by the name that they are declared under; another name is a
// std::logic_error.
class StageRows {
 public:
  explicit StageRows(const MetricFamily& family) : family_(family) {}

  using Members = std::vector<std::string>;
  // A value that is not finite counts as failed.
  void add(const std::string& metric, const Members& members, double value, long samples = 1);
  // The pipeline gave nothing to measure.
  void fail(const std::string& metric, const Members& members) { without_value(metric, members, "failed"); }
  // The truth has no such thing.
  void absent(const std::string& metric, const Members& members) { without_value(metric, members, "absent"); }
  // "failed" or "absent".
  void without_value(const std::string& metric, const Members& members, const std::string& status);

  std::vector<ScoreRow> rows;

 private:
  const MetricFamily& family_;
};

// Metrics of one stage that are measured together. A file of eval/score that defines one registers it,
//   const MetricFamily bias_metrics{"surface", "bias", {Metric{"<slot>/bias_mm", 1, "mm", Better::near_zero, "..."}},
//   judge_bias};
// and evaluate() runs it: a new metric edits no other file. Families of a stage run in the order of their names, that
// named as the stage first.
class MetricFamily {
 public:
  using Judge = void (*)(const Judged&, StageRows&);
  MetricFamily(std::string stage, std::string name, std::vector<Metric> metrics, Judge judge);
  MetricFamily(const MetricFamily&) = delete;
  MetricFamily& operator=(const MetricFamily&) = delete;

  const std::string& stage() const { return stage_; }
  const std::string& name() const { return name_; }
  const std::vector<Metric>& metrics() const { return metrics_; }
  const Metric& at(const std::string& metric) const;  // std::logic_error when it is not declared
  std::vector<ScoreRow> judge(const Judged& run) const;

 private:
  std::string stage_, name_;
  std::vector<Metric> metrics_;
  Judge judge_;
};

// The registered families in the order of the pipeline's stages. Throws std::logic_error when one names a stage that
// the pipeline does not have, or two of a stage have one name.
std::vector<const MetricFamily*> metric_families();

}  // namespace dressform
