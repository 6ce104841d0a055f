#pragma once
#include <string>
#include <vector>

#include "eval/score/metric.h"

namespace dressform {

// The declared metrics as people and programs read them.
std::string metrics_markdown(const std::vector<const Metric*>& metrics);
std::string metrics_csv(const std::vector<const Metric*>& metrics);
std::string metrics_json(const std::vector<const Metric*>& metrics);

// What the lines of the first score table mean, with their targets: the metrics that declare a headline.
std::string legend_markdown(const std::vector<const Metric*>& metrics);

// Those of one stage; of all where it is empty. Throws InputError naming the stages that have metrics.
std::vector<const Metric*> metrics_of(const std::string& stage);

// A document with its tables of metrics written anew: what lies between the lines "<!-- metrics -->" or
// "<!-- metrics: legend -->" and "<!-- /metrics -->". Throws InputError naming `where` when there is no such table, or
// one that does not end.
std::string with_metric_tables(const std::string& document, const std::string& where);

}  // namespace dressform
