#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/report/score_table.h"
#include "eval/run/run_facts.h"
#include "eval/score/evaluate.h"
#include "eval/score/mesh_pair.h"
#include "pipeline/run/artifact_store.h"
#include "scenes/file_bytes.h"
#include "scenes/ground_truth.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct ScoreOptions : CommonOptions {
  fs::path run, session, mesh, truth;
  std::string align = "none";
  MeshFrame frame;  // of `mesh`
};

void write_scores(const Scores& scores, const fs::path& output) {
  write_file_atomically(output, scores_to_json(scores));
  fs::path csv = output;
  csv.replace_extension(".csv");
  write_file_atomically(csv, scores_to_csv(scores, fmt::format("{}-{}", scores.scene, scores.seed)));
  fmt::print("scores: {}\n", output.string());
}

int score_run(const ScoreOptions& options) {
  if (!fs::is_directory(options.run / "out"))
    throw InputError(options.run.string(), "has no folder out/; expected a run folder");
  const RunFacts facts = read_run_facts(options.run);
  const fs::path session = options.session.empty() ? facts.session : options.session;
  if (session.empty())
    throw InputError("--session", "missing, and run.json names none; expected a session with ground truth");
  if (!ground_truth_exists(session))
    throw InputError((session / "truth").string(), "no ground truth; expected a synthetic session");
  Scores scores = evaluate(read_foreign_outputs(options.run), read_ground_truth(session));
  scores.scene = facts.scene.value_or(session.filename().string());
  scores.variant = facts.variant.value_or("default");
  scores.seed = facts.seed.value_or(0);
  fmt::print("{}\n", score_table_text(scores, facts.scale));
  write_scores(scores, options.output.empty() ? options.run / "scores.json" : options.output);
  return kSuccess;
}

int score_meshes(const ScoreOptions& options) {
  const auto result =
      score_mesh_pair(options.mesh, options.truth,
                      options.align == "gauge" ? MeshAlignment::gauge : MeshAlignment::none, options.frame);
  const Isometry3d& motion = result.truth_from_estimate;
  if (options.align == "gauge")
    fmt::print("taken out first: a turn of {:.3f} deg and a step of {:.2f} mm; the scores say nothing of the pose\n",
               Eigen::AngleAxisd(motion.linear()).angle() * 180 / M_PI, 1000 * motion.translation().norm());
  fmt::print("{}\n", score_table_text(result.scores));
  if (!options.output.empty()) write_scores(result.scores, options.output);
  return kSuccess;
}

int score(const ScoreOptions& options) {
  const ThreadLimit threads(options.threads);
  if (options.mesh.empty() != options.truth.empty())
    throw InputError(options.mesh.empty() ? "--mesh" : "--truth", "missing; expected --mesh FILE --truth FILE");
  if (options.run.empty() == options.mesh.empty())
    throw InputError("score", "expected either a run folder, or --mesh FILE --truth FILE");
  return options.mesh.empty() ? score_run(options) : score_meshes(options);
}

Command add_score_command(CLI::App& app) {
  auto options = std::make_shared<ScoreOptions>();
  auto* command = app.add_subcommand(
      "score", "Score the out/ of a run folder against a session's ground truth, or one mesh against another");
  command->add_option("run", options->run, "run folder (or any folder with an out/ laid out like one)");
  command->add_option("--session", options->session, "session with truth/; default: the one that run.json names");
  command->add_option("-o,--output", options->output,
                      "scores file, with .csv beside it; default RUN/scores.json, none for --mesh");
  command->add_option("--mesh", options->mesh, "instead of a run: one mesh (OBJ, PLY, GLB), against --truth");
  command->add_option("--truth", options->truth, "the true mesh; a PLY's vertex property `views` tells what was seen");
  command
      ->add_option("--align", options->align,
                   "none (default): both meshes are in one frame; gauge: the best rigid motion is taken out first")
      ->check(CLI::IsMember({"none", "gauge"}));
  add_mesh_frame(*command, options->frame);
  add_threads(*command, *options);
  command->footer(
      "Examples:\n  dressform score runs/group1 --session sessions/group1\n"
      "  dressform score --mesh mine/top.ply --truth sessions/group1/truth/garments/top.ply -o mine/scores.json");
  return [options] { return score(*options); };
}

const RegisteredCommand registered_score{80, add_score_command};

}  // namespace
}  // namespace dressform
