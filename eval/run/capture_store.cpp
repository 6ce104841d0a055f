#include "eval/run/capture_store.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "eval/run/truth_hash.h"
#include "pipeline/run/place_folder.h"
#include "scenes/capture_session.h"
#include "scenes/file_bytes.h"
#include "scenes/ground_truth.h"
#include "scenes/hash.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Meshes and textures that the scene brings along, with the material libraries and images that they name.
std::vector<fs::path> own_files(const Scene& scene) {
  std::vector<fs::path> files{scene.body.mesh, scene.user.mesh};
  for (const auto& garment : scene.garments) {
    files.push_back(garment.texture);
    if (garment.mesh.empty()) continue;
    for (const auto& file : mesh_files(garment.mesh)) files.push_back(file);
  }
  files.erase(std::remove(files.begin(), files.end(), fs::path{}), files.end());
  return files;
}

Recipe recipe_of(const Scene& scene, double scale, Seed seed) {
  Recipe recipe{
      "synthesize", scene.sensor_model.variant, code_version("synthetic"), scene.sensor_model.values, seed, {}};
  recipe.values["scale"] = scale;
  recipe.inputs.push_back(hash_hex(scene.toml));
  for (const auto& file : own_files(scene)) recipe.inputs.push_back(hash_file(file));
  return recipe;
}

// Hash over the capture with truth and picks: the session's own hash leaves them out.
std::string whole_hash(const fs::path& session) {
  return hash_hex(session_content_hash(session) + " " + truth_hash(session) + " " + picks_content_hash(session));
}

// The record of an intact capture; null otherwise.
json intact_record(const fs::path& folder) {
  try {
    std::ifstream in(folder / "capture.json");
    const json record = in ? json::parse(in) : json();
    if (record.is_object() && record.at("content_hash") == whole_hash(folder / "session")) return record;
  } catch (const json::exception&) {  // a damaged record or session is captured again
  } catch (const fs::filesystem_error&) {
  } catch (const InputError&) {
  }
  return {};
}

}  // namespace

std::string scene_hash(const Scene& scene) {
  std::string text = hash_hex(scene.toml);
  for (const auto& file : own_files(scene)) text += " " + hash_file(file);
  return hash_hex(text);
}

StoredCapture stored_capture(const Scene& scene, double scale, Seed seed, ArtifactStore& store,
                             const SynthesisProgress& progress) {
  const Recipe recipe = recipe_of(scene, scale, seed);
  const fs::path at = store.folder(recipe), session = at / "session";
  if (const json record = intact_record(at); !record.is_null())
    return {session, recipe, record.value("seconds", 0.0), record.value("peak_memory_mb", 0.0), true};

  reset_peak_memory();
  const auto start = std::chrono::steady_clock::now();
  const auto capture = synthesize(scene, seed, progress);
  StoredCapture result{session, recipe, 0, 0, false};
  place_folder(
      at,
      [&](const fs::path& folder) {
        write_capture_session(folder / "session", capture.session);
        write_ground_truth(folder / "session", capture.truth);
        if (capture.picks) write_picks(folder / "session", *capture.picks);
        result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        result.peak_memory_mb = peak_memory_mb();
        write_file_atomically(folder / "capture.json", json{{"content_hash", whole_hash(folder / "session")},
                                                            {"key", recipe.key()},
                                                            {"seconds", result.seconds},
                                                            {"peak_memory_mb", result.peak_memory_mb}}
                                                               .dump(1) +
                                                           "\n");
      },
      [&] { return !intact_record(at).is_null(); });
  return result;
}

}  // namespace dressform
