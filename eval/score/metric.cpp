#include "eval/score/metric.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "eval/score/metric_family.h"

namespace dressform {
namespace {

// The literal parts of a pattern, one more than it has <>.
std::vector<std::string> literal_parts(const std::string& pattern) {
  std::vector<std::string> parts(1);
  for (std::size_t at = 0; at < pattern.size(); ++at) {
    if (pattern[at] != '<') {
      parts.back() += pattern[at];
      continue;
    }
    at = pattern.find('>', at);
    parts.emplace_back();
  }
  return parts;
}

std::size_t literal_length(const std::string& pattern) {
  std::size_t length = 0;
  for (const auto& part : literal_parts(pattern)) length += part.size();
  return length;
}

// What stands between the literal parts of a text; absent when the text has another form.
std::optional<std::vector<std::string>> between(const std::vector<std::string>& parts, const std::string& text) {
  std::vector<std::string> members;
  if (text.compare(0, parts[0].size(), parts[0]) != 0) return {};
  std::size_t at = parts[0].size();
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const bool last = k + 1 == parts.size();
    const std::size_t size = parts[k].size();
    const std::size_t next = !last                     ? text.find(parts[k], at + 1)
                             : text.size() < at + size ? std::string::npos
                                                       : text.size() - size;
    if (next == std::string::npos || next <= at || text.compare(next, size, parts[k]) != 0) return {};
    members.push_back(text.substr(at, next - at));
    if (members.back().find('/') != std::string::npos) return {};
    at = next + size;
  }
  if (at != text.size()) return {};
  return members;
}

Nuisance nuisance_of_unit(const std::string& unit) {
  if (unit == "mm") return {"length", 0.25, 0.02};
  if (unit == "deg") return {"angle", 0.02, 0};
  if (unit == "count") return {"exact", 0, 0};
  if (unit == "dB") return {"decibel", 0.2, 0};
  return {"ratio", 0.01, 0};
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit == "1" || unit == "count" ? number : number + " " + unit;
}

}  // namespace

double Nuisance::tolerance(double value) const { return absolute + relative * std::abs(value); }

Metric Metric::with_target(double bound, double holds_from_scale) const {
  Metric result = *this;
  result.target = bound;
  result.from_scale = holds_from_scale;
  return result;
}

Metric Metric::with_headline(const std::string& words) const {
  Metric result = *this;
  result.headline = words;
  return result;
}

Metric Metric::for_only(const std::string& member) const {
  Metric result = *this;
  result.only = member;
  return result;
}

Metric Metric::after(const std::string& source) const {
  Metric result = *this;
  result.paper = source;
  return result;
}

std::string Metric::row_name(const std::vector<std::string>& members) const {
  const auto parts = literal_parts(name);
  if (parts.size() != members.size() + 1)
    throw std::logic_error(fmt::format("metric {}: {} members given", name, members.size()));
  std::string text = parts[0];
  for (std::size_t k = 0; k < members.size(); ++k) text += members[k] + parts[k + 1];
  return text + "@" + std::to_string(version);
}

std::optional<std::vector<std::string>> Metric::members_of(const std::string& row_name) const {
  auto parts = literal_parts(name);
  parts.back() += "@" + std::to_string(version);
  return between(parts, row_name);
}

bool Metric::judges(const std::vector<std::string>& members) const {
  return only.empty() || std::find(members.begin(), members.end(), only) != members.end();
}

Nuisance Metric::nuisance() const { return own_nuisance.value_or(nuisance_of_unit(unit)); }

bool Metric::meets_target(double value) const {
  if (!target) return true;
  if (better == Better::higher) return value >= *target;
  return (better == Better::near_zero ? std::abs(value) : value) <= *target;
}

std::string Metric::target_text() const {
  if (!target) return {};
  const char* relation = better == Better::higher ? ">=" : better == Better::near_zero ? "within +-" : "<=";
  return with_unit(fmt::format("{} {:g}", relation, *target), unit);
}

std::string number_text(double value, const std::string& unit) {
  const int digits = unit == "count" ? 0 : unit == "1" || unit == "deg" ? 3 : 2;
  return with_unit(fmt::format("{:.{}f}", value, digits), unit);
}

std::vector<const Metric*> all_metrics() {
  std::vector<const Metric*> result;
  for (const MetricFamily* family : metric_families())
    for (const Metric& metric : family->metrics()) result.push_back(&metric);
  return result;
}

const Metric* find_metric(const std::string& stage, const std::string& row_name) {
  const Metric* found = nullptr;
  for (const Metric* metric : all_metrics())
    if (metric->stage == stage && metric->members_of(row_name) &&
        (!found || literal_length(metric->name) > literal_length(found->name)))
      found = metric;
  return found;
}

}  // namespace dressform
