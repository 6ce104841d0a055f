#include "pipeline/reconstruct.h"

namespace dressform {
namespace {

struct AnyStage {
  StageDescription description;
  std::function<void(const std::string& variant, const FieldValues& values)> check;
};

template <class StageType>
AnyStage describe() {
  StageDescription description{StageType::name(), StageType::default_variant(), {}};
  for (const auto& name : StageType::names())
    description.variants.push_back({name, StageType::at(name).fields, StageType::at(name).picks});
  return {description,
          [](const std::string& variant, const FieldValues& values) { StageType::at(variant).complete(values); }};
}

std::vector<AnyStage> all_stages() {
  return {describe<Calibrate>(), describe<EstimateMultipath>(),
          describe<Fuse>(),      describe<Extract>(),
          describe<Register>(),  describe<FindLandmarks>(),
          describe<Segment>(),   describe<Fill>(),
          describe<Surface>(),   describe<Open>(),
          describe<Texture>(),   describe<Fit>(),
          describe<Correct>()};
}

std::string known_stages() {
  std::string text;
  for (const auto& stage : all_stages()) text += (text.empty() ? "" : ", ") + stage.description.name;
  return text;
}

}  // namespace

std::vector<StageDescription> describe_stages() {
  std::vector<StageDescription> result;
  for (auto& stage : all_stages()) result.push_back(std::move(stage.description));
  return result;
}

void choose_variant(ReconstructionOptions& options, const std::string& stage, const std::string& variant) {
  std::string& chosen = options.variants[stage];
  if (chosen != variant) options.values.erase(stage);
  chosen = variant;
}

void check_options(const ReconstructionOptions& options) {
  std::map<std::string, AnyStage> stages;
  for (auto& stage : all_stages()) stages.emplace(stage.description.name, std::move(stage));
  for (const auto& [stage, variant] : options.variants)
    if (!stages.count(stage))
      throw InputError("--variant " + stage + "=" + variant, "no such stage; expected one of " + known_stages());
  for (const auto& [stage, values] : options.values)
    if (!stages.count(stage)) throw InputError("--set " + stage, "no such stage; expected one of " + known_stages());
  for (const auto& [name, stage] : stages) {
    const auto variant = options.variants.find(name);
    const auto values = options.values.find(name);
    stage.check(variant == options.variants.end() ? stage.description.default_variant : variant->second,
                values == options.values.end() ? FieldValues{} : values->second);
  }
}

}  // namespace dressform
