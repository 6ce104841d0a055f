#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/fields.h"
#include "scenes/registry.h"

namespace dressform {

// What an artifact was made from. Its hash is the artifact's key: no paths, no times.
struct Recipe {
  std::string stage, variant, code_version;
  FieldValues values;  // all parameters, defaults included
  Seed seed = 0;
  std::vector<std::string> inputs;  // content hashes of the inputs, in the order of the stage's arguments

  std::string key() const;
};

// What is known about an artifact that was made: kept beside its bytes as artifact.json.
struct ArtifactRecord {
  Recipe recipe;
  std::string content_hash;  // of the bytes: damage is found by it, and it names the artifact to those that follow
  std::uint64_t size = 0;
  double seconds = 0;
  double peak_memory_mb = 0;
};

// Stage results under content keys. Writes go to a temporary name, then rename: a reader never sees half an artifact.
class ArtifactStore {
 public:
  explicit ArtifactStore(std::filesystem::path root);

  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path folder(const Recipe& recipe) const;

  // The record of an intact artifact; nothing when there is none, or it is truncated or damaged.
  std::optional<ArtifactRecord> find(const Recipe& recipe) const;
  // The bytes of an artifact that `find` returned. Throws std::runtime_error when they changed since.
  std::string load(const ArtifactRecord& record) const;
  ArtifactRecord save(const Recipe& recipe, const std::string& bytes, double seconds, double peak_memory_mb);

 private:
  std::filesystem::path root_;
};

// Hash of the sources of a stage, derived at build time (scripts/cmake/code_versions.cmake).
std::string code_version(const std::string& stage);

// Peak resident memory in MB since the last call of reset_peak_memory (Linux; 0 where it can't be told).
void reset_peak_memory();
double peak_memory_mb();

}  // namespace dressform
