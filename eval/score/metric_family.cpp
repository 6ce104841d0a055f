#include "eval/score/metric_family.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>

#include "pipeline/reconstruct.h"

namespace dressform {
namespace {

std::vector<const MetricFamily*>& registered() {
  static std::vector<const MetricFamily*> families;
  return families;
}

std::vector<const MetricFamily*> in_order() {
  std::map<std::string, int> ranks;
  for (const auto& stage : describe_stages()) ranks.emplace(stage.name, static_cast<int>(ranks.size()));
  std::map<std::tuple<int, bool, std::string>, const MetricFamily*> ordered;
  for (const auto* family : registered()) {
    const auto rank = ranks.find(family->stage());
    if (rank == ranks.end())
      throw std::logic_error("metrics " + family->name() + ": no stage \"" + family->stage() + "\"");
    const std::tuple key(rank->second, family->name() != family->stage(), family->name());
    if (!ordered.emplace(key, family).second)
      throw std::logic_error("metrics " + family->name() + " of " + family->stage() + " are registered twice");
  }
  std::vector<const MetricFamily*> result;
  for (const auto& [key, family] : ordered) result.push_back(family);
  return result;
}

}  // namespace

std::vector<std::string> judged_slots(const Judged& run) {
  std::vector<std::string> slots;
  for (const auto& [slot, garment] : run.truth.garments) slots.push_back(slot);
  if (slots.empty())
    for (const auto& [slot, garment] : run.outputs.garments) slots.push_back(slot);
  return slots;
}

void StageRows::add(const std::string& metric, const Members& members, double value, long samples) {
  if (!std::isfinite(value)) return fail(metric, members);
  const Metric& declared = family_.at(metric);
  rows.push_back({family_.stage(), declared.row_name(members), declared.unit, value, "ok", samples});
}

void StageRows::without_value(const std::string& metric, const Members& members, const std::string& status) {
  const Metric& declared = family_.at(metric);
  rows.push_back({family_.stage(), declared.row_name(members), declared.unit, std::numeric_limits<double>::quiet_NaN(),
                  status, 0});
}

MetricFamily::MetricFamily(std::string stage, std::string name, std::vector<Metric> metrics, Judge judge)
    : stage_(std::move(stage)), name_(std::move(name)), metrics_(std::move(metrics)), judge_(judge) {
  for (auto& metric : metrics_) metric.stage = stage_;
  registered().push_back(this);
}

const Metric& MetricFamily::at(const std::string& metric) const {
  const auto found =
      std::find_if(metrics_.begin(), metrics_.end(), [&](const Metric& each) { return each.name == metric; });
  if (found == metrics_.end()) throw std::logic_error("metric " + stage_ + " " + metric + " is not declared");
  return *found;
}

std::vector<ScoreRow> MetricFamily::judge(const Judged& run) const {
  StageRows rows(*this);
  judge_(run, rows);
  return rows.rows;
}

std::vector<const MetricFamily*> metric_families() {
  static const std::vector<const MetricFamily*> families = in_order();
  return families;
}

}  // namespace dressform
