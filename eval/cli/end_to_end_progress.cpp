#include "eval/cli/end_to_end_progress.h"

#include <fmt/format.h>

#include "eval/report/score_table.h"
#include "scenes/ground_truth.h"

namespace dressform {

EndToEndProgress end_to_end_progress(Progress& progress) {
  EndToEndProgress result;
  result.stage = [&progress](const StageRecord& record, bool finished) {
    const std::string what = record.label + " (" + record.recipe.variant + ")";
    if (!finished)
      progress.update(what);
    else
      progress.finish(what, record.reused
                                ? "reused"
                                : seconds_text(record.seconds) + fmt::format("  {:.0f} MB", record.peak_memory_mb));
  };
  result.step = [&progress](const std::string& step) { progress.update(step); };
  result.step_finished = [&progress](const std::string& step, bool made, double seconds) {
    progress.finish(step, made ? seconds_text(seconds) : "up to date");
  };
  return result;
}

SceneRunProgress scene_progress(Progress& progress) {
  SceneRunProgress result;
  result.capture = [&progress](int done, int total, const std::string& what) {
    progress.update("synthesize: " + what, done, total);
  };
  result.captured = [&progress](const StoredCapture& capture) {
    progress.finish(
        "synthesize (" + capture.recipe.variant + ")",
        capture.reused ? "reused" : seconds_text(capture.seconds) + fmt::format("  {:.0f} MB", capture.peak_memory_mb));
    for (const std::string& line : drape_warnings(capture.session)) progress.finish("warning", line);
  };
  result.pipeline = end_to_end_progress(progress);
  return result;
}

ExitCode print_summary(const EndToEndResult& result) {
  if (result.scores)
    fmt::print("\n{}\n", score_table_text(*result.scores, result.scale));
  else
    fmt::print("\nno ground truth in the session: nothing to score\n");
  fmt::print("report: {}\n", std::filesystem::absolute(result.report).lexically_normal().string());
  for (const auto& problem : result.problems)
    fmt::print("{} {}\n", problem.garment_missing ? "GARMENT MISSING" : "FAILED", problem.text());
  return garments_missing(result.problems) ? kGarmentsMissing : kSuccess;
}

}  // namespace dressform
