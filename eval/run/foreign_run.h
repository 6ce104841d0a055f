#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "eval/score/scores.h"

namespace dressform {

// What a program of someone else's left for us: the folder RUN with RUN/out laid out as dressform's own out/, which is
// scored here, or with the scores that the program gave itself (eval/studies/README.md, "Other people's pipelines").
struct ForeignRun {
  Scores scores;                                // no rows where nothing is known to score by
  bool scored_here = false;                     // by us, from meshes and poses; else as the program says
  std::vector<std::filesystem::path> pictures;  // of RUN/out/pictures/*.png, sorted; readable ones
};

// Reads RUN/out. `session`: the capture, whose truth/ what lies there is scored by; empty, or without truth: meshes and
// poses give no scores. Throws InputError, naming file and field, where RUN/out has neither registration.json nor
// scores.json, or both; is damaged; where a declared metric has another unit than declared, a row has another status
// than "ok", "failed" and "absent", or a value that is no number, or a row stands there twice; where a picture is no
// PNG, or larger than kLargestPicture a side.
ForeignRun read_foreign_run(const std::filesystem::path& run_folder, const std::filesystem::path& session);

constexpr int kLargestPicture = 8192;  // pixels a side: what a person can still look at

}  // namespace dressform
