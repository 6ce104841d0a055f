#pragma once
#include <chrono>
#include <string>
#include <utility>

#include "pipeline/reconstruct.h"
#include "pipeline/run/given_artifacts.h"
#include "scenes/hash.h"
#include "scenes/picks.h"
#include "scenes/serialize.h"

namespace dressform {

// Runs stages through the artifact store and keeps a record of each: what is there is not made again.
class StageRunner {
 public:
  StageRunner(const ReconstructionOptions& options, ArtifactStore& store, StageProgress progress,
              GivenArtifacts given = {})
      : options_(options), store_(store), progress_(std::move(progress)), given_(std::move(given)) {}

  // Runs (or finds) the chosen variant of a stage. `label` tells two runs of one stage apart ("fuse_naked").
  template <class StageType, class... In>
  LazyArtifact<typename StageType::Output> run(const std::string& label, const LazyArtifact<In>&... inputs) {
    using Out = typename StageType::Output;
    if (const std::string* bytes = given_.find(label)) return taken<StageType>(label, *bytes);
    const auto& entry = chosen<StageType>();
    std::vector<std::string> used{inputs.content_hash()...};
    if (!entry.picks.empty()) used.push_back(picks_.value().content_hash());
    const Recipe recipe = recipe_of<StageType>(entry, std::move(used));
    auto artifact = store_.find(recipe);
    begin(label, recipe, artifact.has_value());
    std::optional<Out> value;
    if (!artifact) {
      reset_peak_memory();
      const auto start = std::chrono::steady_clock::now();
      value = entry.picks.empty()
                  ? entry.run(inputs.get()..., recipe.values, recipe.seed)
                  : entry.run_with_picks(inputs.get()..., recipe.values, picks_.value().get(), recipe.seed);
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      artifact = store_.save(recipe, to_bytes(*value), seconds.count(), peak_memory_mb());
    }
    end(*artifact);
    ArtifactStore& store = store_;
    LazyArtifact<Out> made(artifact->content_hash,
                           [&store, found = *artifact] { return from_bytes<Out>(store.load(found)); });
    if (value) made.keep(std::move(*value));
    return made;
  }

  const std::vector<StageRecord>& records() const { return records_; }

  // What variants that ask for picks are given from now on; no key of any other depends on it.
  void set_picks(LazyArtifact<Picks> picks) { picks_ = std::move(picks); }

 private:
  // A result that was given: kept like any other, under its own content.
  template <class StageType>
  LazyArtifact<typename StageType::Output> taken(const std::string& label, const std::string& bytes) {
    using Out = typename StageType::Output;
    const Recipe recipe{StageType::name(), "given", "", {}, 0, {hash_hex(bytes)}};
    auto artifact = store_.find(recipe);
    begin(label, recipe, artifact.has_value());
    if (!artifact) artifact = store_.save(recipe, bytes, 0, 0);
    end(*artifact);
    ArtifactStore& store = store_;
    return {artifact->content_hash, [&store, found = *artifact] { return from_bytes<Out>(store.load(found)); }};
  }

  template <class StageType>
  const typename StageType::Entry& chosen() const {
    const auto given = options_.variants.find(StageType::name());
    return StageType::at(given == options_.variants.end() ? StageType::default_variant() : given->second);
  }

  template <class StageType>
  Recipe recipe_of(const typename StageType::Entry& entry, std::vector<std::string> inputs) const {
    const auto given = options_.values.find(StageType::name());
    const auto values = entry.complete(given == options_.values.end() ? FieldValues{} : given->second);
    return {StageType::name(), entry.name, code_version(StageType::name()), values, options_.seed, std::move(inputs)};
  }

  void begin(const std::string& label, const Recipe& recipe, bool reused) {
    records_.push_back({static_cast<int>(records_.size()) + 1, label, recipe, recipe.key(), 0, 0, reused, {}});
    if (progress_) progress_(records_.back(), false);
  }
  void end(const ArtifactRecord& artifact) {
    records_.back().seconds = artifact.seconds;
    records_.back().peak_memory_mb = artifact.peak_memory_mb;
    records_.back().content_hash = artifact.content_hash;
    if (progress_) progress_(records_.back(), true);
  }

  const ReconstructionOptions& options_;
  ArtifactStore& store_;
  StageProgress progress_;
  const GivenArtifacts given_;
  std::vector<StageRecord> records_;
  std::optional<LazyArtifact<Picks>> picks_;
};

}  // namespace dressform
