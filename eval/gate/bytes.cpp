#include "eval/gate/bytes.h"

#include <fmt/format.h>

#include <algorithm>

namespace dressform {
namespace {

const StepBytes* step_in(const std::vector<StepBytes>& steps, const std::string& name) {
  const auto found = std::find_if(steps.begin(), steps.end(), [&](const StepBytes& each) { return each.step == name; });
  return found == steps.end() ? nullptr : &*found;
}

}  // namespace

BytesResult compare_bytes(const std::vector<StepBytes>& then, const Environment& environment_then,
                          const std::vector<StepBytes>& now, const Environment& environment_now) {
  BytesResult result;
  result.environment = environment_difference(environment_then, environment_now);
  if (then.empty()) return result;
  for (const auto& step : now) {
    const StepBytes* old = step_in(then, step.step);
    if (old && old->content == step.content) continue;
    result.changed.push_back(step.step);
    if (!old || old->inputs == step.inputs) result.origins.push_back(step.step);
  }
  for (const auto& step : then)
    if (!step_in(now, step.step)) result.changed.push_back(step.step), result.origins.push_back(step.step);
  // Where all that changed was asked or given something else (a scene, a parameter), it began with the first of them.
  if (result.origins.empty() && !result.changed.empty()) result.origins.push_back(result.changed.front());
  result.state = result.changed.empty()       ? BytesState::identical
                 : result.environment.empty() ? BytesState::changed
                                              : BytesState::other_environment;
  return result;
}

std::string bytes_text(const BytesResult& result) {
  switch (result.state) {
    case BytesState::none_kept:
      return "no bytes kept: accept to keep them";
    case BytesState::identical:
      return result.environment.empty() ? "identical" : "identical, in another environment";
    case BytesState::other_environment:
      return fmt::format("other bytes from {} on, in another environment ({})", result.origins.front(),
                         result.environment);
    case BytesState::changed:
      break;
  }
  std::string also;
  for (std::size_t k = 1; k < result.origins.size(); ++k) also += (k == 1 ? "; also " : ", ") + result.origins[k];
  return fmt::format("changed, first at {} ({} steps have other bytes{})", result.origins.front(),
                     result.changed.size(), also);
}

}  // namespace dressform
