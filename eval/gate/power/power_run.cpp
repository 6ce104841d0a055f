#include "eval/gate/power/power_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/gate/accept.h"
#include "eval/gate/power/planted_store.h"
#include "eval/score/targets.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// What is put into a cell's run, and where.
Placement placement_of(const Fault& fault, int placement) { return {static_cast<Seed>(placement + 1), fault.id()}; }

void replace_step(GoldenRun& run, const std::string& step, const std::string& content) {
  for (auto& each : run.steps)
    if (each.step == step) each.content = content;
}

GoldenRun with_scores(const PowerBase& base, Scores scores) {
  GoldenRun run = base.run;
  scores.scene = run.scores.scene;
  scores.variant = run.scores.variant;
  scores.seed = run.scores.seed;
  run.scores = std::move(scores);
  replace_step(run, "scores", hash_hex(scores_to_json(run.scores)));
  return run;
}

// The faults that need no stage to run again; nothing for the others.
std::optional<GoldenRun> judged_alone(const PowerBase& base, const Fault& fault, double size, const Placement& place) {
  if (fault.on_image) {
    GoldenRun run = base.run;
    for (auto& [stem, image] : run.images) {
      image = image.clone();
      fault.on_image(image, size, place);
      replace_step(run, "image " + stem, pixel_hash(image));
    }
    return run;
  }
  if (fault.on_scores) {
    Scores scores = base.run.scores;
    fault.on_scores(scores, size, place);
    return with_scores(base, scores);
  }
  if (fault.on_scorer) {
    ScorerInput input{read_run_outputs(base.request.output), read_ground_truth(base.session), {}};
    fault.on_scorer(input, size, place);
    return with_scores(base, evaluate(input.outputs, input.truth, input.options));
  }
  return {};
}

// A capture with a fault, beside the truth of the one without.
fs::path faulty_session(const PowerBase& base, const Fault& fault, double size, const Placement& place,
                        const fs::path& folder) {
  CaptureSession session = read_capture_session(base.session);
  fault.on_capture(session, size, place);
  const fs::path faulty = folder / "session";
  write_capture_session(faulty, session);
  for (const char* beside : {"truth", "picks"})
    if (fs::exists(base.session / beside))
      fs::copy(base.session / beside, faulty / beside, fs::copy_options::recursive);
  return faulty;
}

GoldenRun run_faulty(const PowerBase& base, const Fault& fault, double size, const Placement& place,
                     const fs::path& folder, int threads) {
  fs::create_directories(folder);
  const fs::path store = folder / "store";
  plant_artifact(
      base.request.store, base.records, fault.on_artifact ? fault.step : std::string(),
      [&](const std::string& bytes) { return fault.on_artifact(bytes, size, place); }, store);
  SceneRunRequest asked = base.request;
  asked.output = folder / "run";
  EndToEndRequest request{fault.on_capture ? faulty_session(base, fault, size, place, folder) : base.session,
                          asked.output,
                          store,
                          base.run.scores.scene,
                          base.run.scores.variant,
                          base.request.options,
                          false,
                          threads};
  request.report = false;
  request.result_images = true;
  return golden_run_of(run_end_to_end(request, {}), asked);
}

// Hash over the undisturbed run, all code that a run with the fault may go through, and the fault.
std::string cell_key(const PowerBase& base, const Fault& fault, double size, int placement) {
  std::string text = base.run.identity() + code_version("eval") + code_version("render");
  for (const auto& record : base.records) text += record.recipe.code_version;
  return hash_hex(fmt::format("{} {} {} {:.17g} {}", text, base.name, fault.id(), size, placement));
}

PowerCell crashed_cell(const PowerBase& base, const Fault& fault, std::size_t size, int placement,
                       const std::string& why) {
  return {base.name, fault.id(), fault.step, size, placement, true, true, "", "", "crash: " + why};
}

// The order in which numbers are blamed.
int rank_of_stage(const std::string& stage) {
  const auto stages = describe_stages();
  const auto found = std::find_if(stages.begin(), stages.end(), [&](const auto& each) { return each.name == stage; });
  return static_cast<int>(found - stages.begin());  // pictures, and what is no stage: last
}

}  // namespace

std::string stage_of_step(const std::string& step) {
  for (const char* twice : {"fuse", "landmarks"})
    if (step.rfind(std::string(twice) + "_", 0) == 0) return twice;
  return step;
}

GoldenCase reference_of(const std::string& name, const GoldenRun& run) {
  AcceptRequest request{"undisturbed", {}, {}};
  for (const auto& target : target_results(run.scores))
    if (!target.met) request.miss_reasons[target.name()] = "missed without a fault";
  GoldenCase empty;
  empty.name = name;
  return accepted(empty, run, request).golden;
}

PowerBase power_base(const std::string& name, const GoldenRunRequest& asked, const SceneRunProgress& progress) {
  const GoldenCase recipe = read_golden_recipe(asked.golden, name);
  run_golden_case(recipe, asked, progress);  // in the folder of the checks, anew where another environment made it
  PowerBase base;
  base.name = name;
  base.request = scene_request(recipe, asked);
  SceneRunProgress silent;
  silent.captured = [&](const StoredCapture& capture) { base.session = capture.session; };
  const EndToEndResult result = run_scene(base.request, silent);  // all of it is there
  base.records = result.records;
  base.run = golden_run_of(result, base.request);
  base.reference = reference_of(name, base.run);
  return base;
}

PowerCell judged_cell(const PowerBase& base, const Fault& fault, std::size_t size, int placement, const GoldenRun& run,
                      const MeasuredNuisance& nuisance) {
  PowerCell cell{base.name, fault.id(), fault.step, size, placement, false, false, "", "", ""};
  const GateResult result = compare_with_golden(base.reference, run, nuisance);
  cell.found = result.verdict != GateVerdict::pass;
  if (!result.bytes.origins.empty()) cell.by_bytes = result.bytes.origins.front();
  cell.by_numbers = first_failing_stage(result.findings);
  if (!result.findings.empty()) cell.worst = result.findings.front().what() + ": " + result.findings.front().message;
  return cell;
}

PowerCell power_cell(const PowerBase& base, const Fault& fault, std::size_t size, int placement,
                     const PowerRequest& request, const MeasuredNuisance& nuisance) {
  const Placement place = placement_of(fault, placement);
  const double amount = fault.sizes.at(size);
  if (const auto alone = judged_alone(base, fault, amount, place))
    return judged_cell(base, fault, size, placement, *alone, nuisance);
  const std::string key = cell_key(base, fault, amount, placement);
  const fs::path kept = request.work / "cells" / key, crash = kept / "crash.txt",
                 running = request.work / ("run_" + key);
  if (fs::exists(crash)) return crashed_cell(base, fault, size, placement, read_file_bytes(crash));
  try {
    return judged_cell(base, fault, size, placement, read_golden_run(kept), nuisance);
  } catch (const InputError&) {  // not there yet, or damaged
  }
  fs::remove_all(running);
  try {
    const GoldenRun run = run_faulty(base, fault, amount, place, running, request.threads);
    write_golden_run(kept, run);
    fs::remove_all(running);
    return judged_cell(base, fault, size, placement, run, nuisance);
  } catch (const fs::filesystem_error&) {
    throw;  // a full disk is no find
  } catch (const std::exception& error) {
    fs::remove_all(running);
    fs::create_directories(kept);
    write_file_atomically(crash, error.what());
    return crashed_cell(base, fault, size, placement, error.what());
  }
}

bool blamed_right_by_numbers(const PowerCell& cell, const Scores& scores) {
  if (cell.by_numbers.empty()) return false;
  if (cell.step == "scores") return true;  // any number may be the wrong one: bytes alone tell that it is the scorer
  const std::string own = stage_of_step(cell.step);
  if (own == cell.by_numbers) return true;
  const bool has_scores = std::any_of(scores.rows.begin(), scores.rows.end(),
                                      [&](const ScoreRow& row) { return row.stage == own && row.status == "ok"; });
  return !has_scores && (own == "capture" || rank_of_stage(cell.by_numbers) >= rank_of_stage(own));
}

}  // namespace dressform
