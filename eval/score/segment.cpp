#include "eval/metrics/label_metrics.h"
#include "eval/metrics/sampling.h"
#include "eval/score/metric_family.h"
#include "scenes/label.h"

namespace dressform {
namespace {
using namespace metrics;

void judge_segment(const Judged& run, StageRows& rows);

const char* const kPascal = "Everingham et al., IJCV 2010";
const MetricFamily segment_metrics{
    "segment",
    "segment",
    {Metric{"<sensor>/iou_<label>", 1, "1", Better::higher,
            "Intersection over union of the label's pixels, 1 where neither image has any."}
         .after(kPascal),
     Metric{"mean/iou_skin", 1, "1", Better::higher, "Mean over the sensors."}.after(kPascal),
     Metric{"mean/iou_<slot>", 1, "1", Better::higher, "Mean over the sensors."}.after(kPascal).with_headline(
         "IoU <slot>"),
     Metric{"mean/boundary_f_<label>", 1, "1", Better::higher,
            "F of the label's outlines at 2 px, mean over the sensors."}
         .after("Csurka et al., BMVC 2013"),
     {"mean/foreground_leakage", 1, "1", Better::lower,
      "Part of what is labelled a person or cloth that is background, mean over the sensors."},
     {"mean/foreground_miss", 1, "1", Better::lower,
      "Part of the true person and cloth that is labelled background, mean over the sensors."}},
    judge_segment};

struct LabelName {
  const char* name;
  Label label;
};
constexpr LabelName kLabels[] = {{"skin", Label::skin}, {"top", Label::top}, {"bottom", Label::bottom}};

struct LabelPair {
  const cv::Mat &estimate, &truth;
};

// Of the sensors that truth has labels of; a mean over fewer is none.
void add_mean(StageRows& rows, const std::string& metric, const StageRows::Members& members,
              const std::vector<double>& values, std::size_t expected) {
  if (expected == 0)
    rows.absent(metric, members);
  else if (values.size() == expected)
    rows.add(metric, members, mean(values), static_cast<long>(values.size()));
  else
    rows.fail(metric, members);
}

std::vector<LabelPair> add_sensors(StageRows& rows, const Judged& run) {
  std::vector<LabelPair> pairs;
  for (const auto& [sensor, truth] : run.truth.labels) {
    const auto found = run.outputs.labels.find(sensor);
    const bool usable = found != run.outputs.labels.end() && found->second.size() == truth.size();
    for (const auto& [name, label] : kLabels)
      if (usable)
        rows.add("<sensor>/iou_<label>", {sensor, name},
                 label_iou(found->second, truth, static_cast<std::uint8_t>(label)), static_cast<long>(truth.total()));
      else
        rows.fail("<sensor>/iou_<label>", {sensor, name});
    if (usable) pairs.push_back({found->second, truth});
  }
  return pairs;
}

void judge_segment(const Judged& run, StageRows& rows) {
  const auto pairs = add_sensors(rows, run);
  const std::size_t expected = run.truth.labels.size();
  for (const auto& [name, label] : kLabels) {
    const auto value = static_cast<std::uint8_t>(label);
    std::vector<double> overlap, outline;
    for (const auto& [estimate, truth] : pairs) {
      overlap.push_back(label_iou(estimate, truth, value));
      outline.push_back(boundary_f(estimate, truth, value));
    }
    if (label == Label::skin)
      add_mean(rows, "mean/iou_skin", {}, overlap, expected);
    else
      add_mean(rows, "mean/iou_<slot>", {name}, overlap, expected);
    add_mean(rows, "mean/boundary_f_<label>", {name}, outline, expected);
  }
  std::vector<double> leakage, miss;
  for (const auto& [estimate, truth] : pairs) {
    leakage.push_back(foreground_leakage(estimate, truth));
    miss.push_back(foreground_miss(estimate, truth));
  }
  add_mean(rows, "mean/foreground_leakage", {}, leakage, expected);
  add_mean(rows, "mean/foreground_miss", {}, miss, expected);
}

}  // namespace
}  // namespace dressform
