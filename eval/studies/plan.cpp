#include "eval/studies/plan.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "eval/run/capture_store.h"
#include "eval/studies/plan_json.h"
#include "scenes/capture_session.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"
#include "scenes/scene_parts.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kIdDigits = 20;  // of a hash

// The files that a study brings into being in its folder, all of them known before the first is written: relative name,
// bytes.
using NewFiles = std::map<fs::path, std::string>;

PlannedScene planned_file(const fs::path& file) {
  const Scene scene = read_scene(file);
  return {scene.name, false, file, scene_hash(scene), {}};
}

PlannedScene planned_recording(const fs::path& folder) {
  return {folder.filename().string(), true, folder, session_content_hash(folder), {}};
}

PlannedScene planned_draw(const DrawOptions& options, Seed seed, NewFiles& fresh) {
  const DrawnScene drawn = draw_scene(options, seed);
  const fs::path file = fs::path("scenes") / (drawn.name + ".toml");
  Scene alone;  // its text is all there is to it: it names no other file
  alone.toml = fresh[file] = scene_toml(drawn);
  return {drawn.name, false, file, scene_hash(alone), strata_of(drawn)};
}

std::vector<PlannedScene> planned_scenes(const Study& study, NewFiles& fresh) {
  std::vector<PlannedScene> scenes;
  for (const auto& file : study.scenes) scenes.push_back(planned_file(file));
  for (const auto& folder : study.recordings) scenes.push_back(planned_recording(folder));
  for (const auto& range : study.drawn)
    for (int i = 0; i < range.count; ++i)
      scenes.push_back(planned_draw(range.options, static_cast<Seed>(range.first_seed + i), fresh));
  std::set<std::string> names;
  for (const auto& scene : scenes)
    if (!names.insert(scene.name).second)
      throw InputError("scenes", fmt::format("found \"{}\" twice; expected different names (of drawn scenes: other "
                                             "seeds or strata)",
                                             scene.name));
  return scenes;
}

// A rig or scan that a variant brings along is copied, so that the folder can go to another machine.
void keep_file(fs::path& file, std::vector<std::string> (*files_of)(const fs::path&), NewFiles& fresh) {
  if (file.empty()) return;
  const auto parts = files_of(file);
  if (parts.size() > 1)  // the copy would not find them, and a cell would not know when they change
    throw InputError(file.string(),
                     "refers to \"" + parts[1] + "\"; expected a file of a study's variant that stands alone");
  const std::string bytes = read_file_bytes(file);
  const fs::path kept =
      fs::path("rigs") / fmt::format("{}_{}.toml", file.stem().string(), hash_hex(bytes).substr(0, 8));
  fresh[kept] = bytes;
  file = kept;
}

void check_free(const fs::path& folder, const std::string& plan_text) {
  if (!fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder))) return;
  const fs::path file = folder / "study.json";
  if (!fs::is_directory(folder) || !fs::exists(file))
    throw InputError("-o " + folder.string(), "exists and holds no study; expected a new folder");
  if (read_file_bytes(file) != plan_text)
    throw InputError("-o " + folder.string(), "holds another study; expected a new folder, or the same study");
}

// Checked together before anything is written or run.
void check_variants(const Study& study) {
  for (const auto& variant : study.variants) check_options(variant.options);
}

std::string content_of(const fs::path& folder, const fs::path& file) {
  return file.empty() ? std::string() : hash_file(folder / file);
}

}  // namespace

StudyPlan plan_study(const fs::path& study_file, const fs::path& folder) {
  return plan_study(read_study(study_file), read_file_bytes(study_file), folder);
}

StudyPlan plan_study(Study study, const std::string& as_written, const fs::path& folder) {
  StudyPlan plan{std::move(study), {}};
  check_variants(plan.study);
  NewFiles fresh;
  plan.scenes = planned_scenes(plan.study, fresh);
  for (auto& variant : plan.study.variants) {
    keep_file(variant.rig, files_of_rig, fresh);
    keep_file(variant.scan, files_of_scan, fresh);
  }
  plan.study.scenes.clear();
  plan.study.recordings.clear();
  plan.study.drawn.clear();
  const std::string text = plan_json(plan);
  check_free(folder, text);
  for (const auto& [name, bytes] : fresh) {
    fs::create_directories((folder / name).parent_path());
    write_file_atomically(folder / name, bytes);
  }
  fs::create_directories(folder / "cells");
  fs::create_directories(folder / "costs");
  write_file_atomically(folder / "study.toml", as_written);
  write_file_atomically(folder / "study.json", text);  // last: a folder with it is whole
  return plan;
}

StudyPlan read_plan(const fs::path& folder) {
  const fs::path file = folder / "study.json";
  if (!fs::exists(file))
    throw InputError(folder.string(), "holds no study.json; expected a folder made by `dressform study new`");
  return plan_from_json(file);
}

double scale_of(const StudyPlan& plan, const PlannedCell& cell) {
  const double own = plan.study.variants[cell.variant].scale;
  return own > 0 ? own : plan.study.scale;
}

std::vector<PlannedCell> cells_of(const StudyPlan& plan, const fs::path& folder) {
  std::vector<std::string> asked;  // by variant
  for (const auto& variant : plan.study.variants)
    asked.push_back(variant_json(variant, false).dump() + content_of(folder, variant.rig) +
                    content_of(folder, variant.scan));
  std::vector<PlannedCell> cells;
  for (std::size_t s = 0; s < plan.scenes.size(); ++s)
    for (const Seed seed : plan.study.seeds)
      for (std::size_t v = 0; v < asked.size(); ++v) {
        const std::string what =
            fmt::format("{}\n{}\n{}\n{}", asked[v], plan.scenes[s].content_hash, seed, plan.study.scale);
        cells.push_back({hash_hex(what).substr(0, kIdDigits), s, seed, v});
      }
  return cells;
}

fs::path cell_file(const fs::path& folder, const std::string& id) { return folder / "cells" / (id + ".json"); }
fs::path cost_file(const fs::path& folder, const std::string& id) { return folder / "costs" / (id + ".json"); }

}  // namespace dressform
