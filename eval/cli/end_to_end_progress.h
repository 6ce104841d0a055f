#pragma once
#include "eval/cli/options.h"
#include "eval/cli/progress.h"
#include "eval/run/scene_run.h"

namespace dressform {

// Progress lines of an end-to-end run: one a stage, with its time or "reused".
EndToEndProgress end_to_end_progress(Progress& progress);
// The same with the capture before it.
SceneRunProgress scene_progress(Progress& progress);

// The score table, where the report is, and each stage that failed: the last thing a run prints. Gives the exit code.
ExitCode print_summary(const EndToEndResult& result);

}  // namespace dressform
