#include "eval/studies/make_cell.h"

#include "eval/run/capture_store.h"
#include "eval/run/scene_run.h"
#include "scenes/capture_session.h"
#include "scenes/scene_parts.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct Machine {
  fs::path study, store;
  int threads = 1;
};

// Files that are not the study's own may have changed since it was planned.
void check_unchanged(const PlannedScene& scene, const std::string& hash_now) {
  if (hash_now != scene.content_hash)
    throw InputError(scene.path.string(), "changed since the study was planned; expected the same, or a new study");
}

Scene scene_of(const StudyPlan& plan, const PlannedCell& cell, const Machine& machine) {
  const PlannedScene& planned = plan.scenes[cell.scene];
  const StudyVariant& variant = plan.study.variants[cell.variant];
  Scene scene = read_scene(machine.study / planned.path);
  check_unchanged(planned, scene_hash(scene));
  if (!variant.rig.empty()) scene = with_rig(scene, machine.study / variant.rig);
  if (!variant.scan.empty()) scene = with_scan(scene, machine.study / variant.scan);
  scene = scaled(scene, scale_of(plan, cell));
  choose_sensor(scene, variant.sensor);
  return scene;
}

EndToEndResult run_scene_cell(const StudyPlan& plan, const PlannedCell& cell, const fs::path& work,
                              const Machine& machine, CellCost& cost) {
  const StudyVariant& variant = plan.study.variants[cell.variant];
  SceneRunRequest request{scene_of(plan, cell, machine),
                          scale_of(plan, cell),
                          work,
                          machine.store,
                          variant.name,
                          variant.options,
                          machine.threads};
  request.options.seed = cell.seed;
  request.report = false;
  request.oracles = variant.oracles;
  SceneRunProgress progress;
  progress.captured = [&cost](const StoredCapture& capture) { cost.capture_seconds = capture.seconds; };
  return run_scene(request, progress);
}

// The recording that a cell is made of, as it was when the study was planned.
fs::path recording_of(const StudyPlan& plan, const PlannedCell& cell, const Machine& machine) {
  const PlannedScene& planned = plan.scenes[cell.scene];
  const StudyVariant& variant = plan.study.variants[cell.variant];
  if (!variant.sensor.variant.empty() || !variant.rig.empty() || !variant.scan.empty() || variant.scale > 0)
    throw InputError("variant " + variant.name,
                     "asks for another capture, which a recording cannot give; expected "
                     "scenes for it");
  check_unchanged(planned, session_content_hash(machine.study / planned.path));
  return machine.study / planned.path;
}

EndToEndResult run_recording_cell(const StudyPlan& plan, const PlannedCell& cell, const fs::path& work,
                                  const Machine& machine) {
  const PlannedScene& planned = plan.scenes[cell.scene];
  const StudyVariant& variant = plan.study.variants[cell.variant];
  EndToEndRequest request;
  request.session = recording_of(plan, cell, machine);
  request.output = work;
  request.store = machine.store;
  request.scene = planned.name;
  request.variant = variant.name;
  request.options = variant.options;
  request.options.seed = cell.seed;
  request.threads = machine.threads;
  request.report = false;
  request.oracles = variant.oracles;
  return run_end_to_end(request, {});
}

// A variant that is someone else's program: the same captures, its command instead of the pipeline.
MadeCell foreign_cell(const StudyPlan& plan, const PlannedCell& cell, const fs::path& work, const Machine& machine) {
  MadeCell made;
  const StudyVariant& variant = plan.study.variants[cell.variant];
  ForeignRequest request{{}, work, cell.seed, machine.threads};
  if (plan.scenes[cell.scene].recording) {
    request.session = recording_of(plan, cell, machine);
  } else {
    ArtifactStore store(machine.store);
    const auto capture = stored_capture(scene_of(plan, cell, machine), scale_of(plan, cell), cell.seed, store, {});
    made.cost.capture_seconds = capture.seconds;
    request.session = capture.session;
  }
  const ForeignResult result = run_foreign_pipeline(*variant.foreign, request);
  made.result.scores = result.scores.rows;
  made.cost.stage_seconds = {{"command", result.seconds}};
  made.cost.peak_memory_mb = result.peak_memory_mb;
  return made;
}

MadeCell pipeline_cell(const StudyPlan& plan, const PlannedCell& cell, const fs::path& work, const Machine& machine) {
  MadeCell made;
  const bool recording = plan.scenes[cell.scene].recording;
  const EndToEndResult result =
      recording ? run_recording_cell(plan, cell, work, machine) : run_scene_cell(plan, cell, work, machine, made.cost);
  for (const auto& problem : result.problems) made.result.problems.push_back(problem.text());
  if (result.scores) made.result.scores = result.scores->rows;
  for (const auto& record : result.records) {
    made.cost.stage_seconds.push_back({record.label, record.seconds});
    made.cost.peak_memory_mb = std::max(made.cost.peak_memory_mb, record.peak_memory_mb);
  }
  return made;
}

MadeCell make_cell(const StudyPlan& plan, const PlannedCell& cell, const fs::path& work, const Machine& machine) {
  const StudyVariant& variant = plan.study.variants[cell.variant];
  return variant.foreign ? foreign_cell(plan, cell, work, machine) : pipeline_cell(plan, cell, work, machine);
}

}  // namespace

MakeCell pipeline_cells(const fs::path& study, const fs::path& store, int threads) {
  const Machine machine{study, store, threads};
  return [machine](const StudyPlan& plan, const PlannedCell& cell, const fs::path& work) {
    return make_cell(plan, cell, work, machine);
  };
}

}  // namespace dressform
