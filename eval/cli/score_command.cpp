#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/evaluate.h"
#include "eval/report/score_table.h"
#include "pipeline/run/artifact_store.h"
#include "scenes/file_bytes.h"
#include "scenes/ground_truth.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct ScoreOptions : CommonOptions {
  fs::path run, session;
};

// The names and the session that a run folder's run.json records.
nlohmann::json run_facts(const fs::path& run) {
  std::ifstream in(run / "run.json");
  const nlohmann::json facts = in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json::object();
  if (facts.is_discarded() || !facts.is_object())
    throw InputError((run / "run.json").string(), "is damaged; expected the JSON that a run wrote");
  return facts;
}

int score_run(const ScoreOptions& options) {
  const ThreadLimit threads(options.threads);
  if (!fs::is_directory(options.run / "out"))
    throw InputError(options.run.string(), "has no folder out/; expected a run folder");
  const auto facts = run_facts(options.run);
  fs::path session = options.session;
  if (session.empty() && facts.contains("session")) session = facts["session"].value("path", std::string());
  if (session.empty())
    throw InputError("--session", "missing, and run.json names none; expected a session with ground truth");
  if (!ground_truth_exists(session))
    throw InputError((session / "truth").string(), "no ground truth; expected a synthetic session");
  Scores scores = evaluate(read_run_outputs(options.run), read_ground_truth(session));
  scores.scene = facts.value("scene", session.filename().string());
  scores.variant = facts.value("variant", std::string("default"));
  scores.seed = facts.value("seed", Seed{0});
  const fs::path output = options.output.empty() ? options.run / "scores.json" : options.output;
  write_file_atomically(output, scores_to_json(scores));
  fs::path csv = output;
  csv.replace_extension(".csv");
  write_file_atomically(csv, scores_to_csv(scores, fmt::format("{}-{}", scores.scene, scores.seed)));
  fmt::print("{}\nscores: {}\n", score_table_text(scores), output.string());
  return kSuccess;
}

Command add_score_command(CLI::App& app) {
  auto options = std::make_shared<ScoreOptions>();
  auto* command = app.add_subcommand("score", "Score the out/ of a run folder against a session's ground truth");
  command->add_option("run", options->run, "run folder (or any folder with an out/ laid out like one)")->required();
  command->add_option("--session", options->session, "session with truth/; default: the one that run.json names");
  command->add_option("-o,--output", options->output, "scores file; default RUN/scores.json, with .csv beside it");
  add_threads(*command, *options);
  command->footer("Example:\n  dressform score runs/group1 --session sessions/group1");
  return [options] { return score_run(*options); };
}

const RegisteredCommand registered_score{80, add_score_command};

}  // namespace
}  // namespace dressform
