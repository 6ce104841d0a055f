#include "eval/studies/attribution.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/score/metric.h"
#include "scenes/error.h"

namespace dressform {
namespace {

struct StageChoice {
  std::string variant;
  FieldValues values;
  bool operator==(const StageChoice& other) const { return variant == other.variant && values == other.values; }
};

StageChoice choice_of(const ReconstructionOptions& options, const StageDescription& stage) {
  StageChoice choice{stage.default_variant, {}};
  if (const auto found = options.variants.find(stage.name); found != options.variants.end())
    choice.variant = found->second;
  if (const auto found = options.values.find(stage.name); found != options.values.end()) choice.values = found->second;
  return choice;
}

void choose(ReconstructionOptions& options, const std::string& stage, const StageChoice& choice) {
  options.variants[stage] = choice.variant;
  options.values.erase(stage);
  if (!choice.values.empty()) options.values[stage] = choice.values;
}

std::string first_of_b(std::size_t count) { return fmt::format("first {} of B", count); }
std::string last_of_b(std::size_t count) { return fmt::format("last {} of B", count); }

std::size_t place_of(const StudyPlan& plan, const std::string& name) {
  const auto& variants = plan.study.variants;
  const auto found =
      std::find_if(variants.begin(), variants.end(), [&](const StudyVariant& each) { return each.name == name; });
  if (found == variants.end())
    throw InputError(plan.study.name, "has no variant \"" + name + "\"; expected a study made by `study attribute`");
  return static_cast<std::size_t>(found - variants.begin());
}

// The variants along one order, from A to B; step k swaps one stage more.
struct Walk {
  std::vector<std::size_t> from_first, from_last;
};
Walk walk_of(const StudyPlan& plan, std::size_t stages) {
  Walk walk;
  for (std::size_t k = 0; k <= stages; ++k) {
    const bool end = k == 0 || k == stages;
    walk.from_first.push_back(place_of(plan, end ? (k == 0 ? "A" : "B") : first_of_b(k)));
    walk.from_last.push_back(place_of(plan, end ? (k == 0 ? "A" : "B") : last_of_b(k)));
  }
  return walk;
}

std::optional<std::vector<double>> values_along(const StudyResults& results, const std::vector<std::size_t>& walk,
                                                std::size_t scene, const StudyMetric& metric) {
  std::vector<double> values;
  for (const std::size_t variant : walk) {
    const Outcome outcome = results.outcome(variant, scene, metric);
    if (outcome.state != Outcome::State::measured) return {};
    values.push_back(outcome.value);
  }
  return values;
}

Attribution attribution_by(const StudyResults& results, const StudyMetric& metric, const Walk& walk,
                           const std::vector<std::string>& stages) {
  Attribution result;
  result.metric = &metric;
  result.planned_scenes = results.plan.scenes.size();
  for (const auto& stage : stages) result.parts.push_back({stage, 0, 0, {}, {}});
  std::vector<double> a, b;
  for (std::size_t scene = 0; scene < results.plan.scenes.size(); ++scene) {
    const auto first = values_along(results, walk.from_first, scene, metric);
    const auto last = values_along(results, walk.from_last, scene, metric);
    if (!first || !last) continue;
    result.scenes.push_back(results.plan.scenes[scene].name);
    a.push_back(first->front());
    b.push_back(first->back());
    for (std::size_t k = 0; k < stages.size(); ++k) {
      result.parts[k].from_first_scenes.push_back((*first)[k + 1] - (*first)[k]);
      const std::size_t step = stages.size() - k;  // the last stage is swapped in the first step
      result.parts[k].from_last_scenes.push_back((*last)[step] - (*last)[step - 1]);
    }
  }
  if (result.scenes.empty()) return result;
  result.a = mean_of(a);
  result.b = mean_of(b);
  for (auto& part : result.parts) {
    part.from_first = mean_of(part.from_first_scenes);
    part.from_last = mean_of(part.from_last_scenes);
  }
  return result;
}

// "+0.012 (+0.004 to +0.020)": mean, and least and most of the scenes.
std::string part_text(const StudyMetric& metric, double mean, const std::vector<double>& scenes) {
  const auto [least, most] = std::minmax_element(scenes.begin(), scenes.end());
  return fmt::format("{} ({} to {})", difference_text(metric, mean), difference_text(metric, *least),
                     difference_text(metric, *most));
}

}  // namespace

AttributionStudy attribution_of(const ReconstructionOptions& a, const ReconstructionOptions& b) {
  AttributionStudy study;
  std::vector<StageChoice> of_b;
  for (const auto& stage : describe_stages()) {
    const StageChoice choice = choice_of(b, stage);
    if (choice_of(a, stage) == choice) continue;
    study.stages.push_back(stage.name);
    of_b.push_back(choice);
  }
  if (study.stages.empty())
    throw InputError("A and B", "are the same in every stage; expected two pipelines that differ");
  const auto add = [&](const std::string& name, std::size_t from, std::size_t to) {
    StudyVariant variant;
    variant.name = name;
    variant.options = a;
    for (std::size_t k = from; k < to; ++k) choose(variant.options, study.stages[k], of_b[k]);
    study.variants.push_back(variant);
  };
  const std::size_t count = study.stages.size();
  add("A", 0, 0);
  for (std::size_t k = 1; k < count; ++k) add(first_of_b(k), 0, k);
  add("B", 0, count);
  for (std::size_t k = 1; k < count; ++k) add(last_of_b(k), count - k, count);
  return study;
}

std::vector<Attribution> attributions(const StudyResults& results, const std::vector<std::string>& stages) {
  const Walk walk = walk_of(results.plan, stages.size());
  std::vector<Attribution> all;
  for (const auto& metric : results.plan.study.metrics) all.push_back(attribution_by(results, metric, walk, stages));
  return all;
}

std::string attribution_markdown(const StudyResults& results, const std::vector<Attribution>& attributions) {
  std::string text = fmt::format("# {}\n\n{}\n", results.plan.study.name, results.plan.study.description);
  text +=
      "\nEach stage in which B differs from A is swapped in two orders: from the first stage on, and from the last one "
      "back. Beside the mean stand the least and the most of the scenes. Each column adds up to the whole change; "
      "where "
      "the two differ, stages lean on one another.\n";
  for (const auto& each : attributions) {
    text += fmt::format("\n## {}\n\n", each.metric->text);
    if (each.scenes.empty()) {
      text += fmt::format("None of the {} scenes has a number from every variant.\n", each.planned_scenes);
      continue;
    }
    const std::string& unit = each.metric->metric->unit;
    text +=
        fmt::format("A {}, B {}: {} over {} of {} scenes.\n\n", number_text(each.a, unit), number_text(each.b, unit),
                    difference_text(*each.metric, each.b - each.a), each.scenes.size(), each.planned_scenes);
    text += "| stage | from the first on | from the last back | mean of both |\n|---|---|---|---|\n";
    for (const auto& part : each.parts)
      text += fmt::format("| {} | {} | {} | {} |\n", part.stage,
                          part_text(*each.metric, part.from_first, part.from_first_scenes),
                          part_text(*each.metric, part.from_last, part.from_last_scenes),
                          difference_text(*each.metric, (part.from_first + part.from_last) / 2));
  }
  text += "\nSignature:";
  for (const auto& [name, value] : results.signature) text += fmt::format(" {} {};", name, value);
  text.back() = '.';
  return text + "\n";
}

std::string attribution_csv(const std::vector<Attribution>& attributions) {
  std::string text = "metric,stage,order,scene,part,unit\n";
  for (const auto& each : attributions)
    for (const auto& part : each.parts)
      for (std::size_t s = 0; s < each.scenes.size(); ++s)
        for (const auto& [order, values] :
             {std::pair("first", &part.from_first_scenes), std::pair("last", &part.from_last_scenes)})
          text += fmt::format("\"{}\",{},{},{},{},{}\n", each.metric->text, part.stage, order, each.scenes[s],
                              (*values)[s], each.metric->metric->unit);
  return text;
}

}  // namespace dressform
