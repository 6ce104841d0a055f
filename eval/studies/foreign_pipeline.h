#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/score/scores.h"
#include "scenes/toml_section.h"

namespace dressform {

// A pipeline of someone else's: a command that gets a capture and leaves meshes or scores (eval/studies/README.md,
// "Other people's pipelines").
struct ForeignPipeline {
  struct File {
    std::filesystem::path path;
    std::string hash;  // when the study was planned
  };
  std::string command;           // for /bin/sh, with {session} {out} {seed} {threads} {folder}
  double limit_s = 3600;         // then the cell has failed
  std::string version;           // of the program, where its files do not tell
  std::vector<File> files;       // that the program is made of: a change of one is a change of the variant
  std::filesystem::path folder;  // of the study file
};

// The keys command, limit_s, version and files of a [[variant]] table; nothing without a command. Throws InputError
// for a placeholder that is not known, a command that never says {out}, and files that are not there.
std::optional<ForeignPipeline> read_foreign_pipeline(TomlSection& section);

// For study.json. Without `with_paths`, what the results depend on alone: the cell's name is made from it.
nlohmann::json foreign_json(const ForeignPipeline& pipeline, bool with_paths);
ForeignPipeline foreign_from_json(const nlohmann::json& text);

struct ForeignResult {
  Scores scores;
  double seconds = 0, peak_memory_mb = 0;
};
struct ForeignRequest {
  std::filesystem::path session;  // a capture; the command sees it without truth/ and picks/
  std::filesystem::path work;     // an empty folder: out/, session/, command_output.txt, command_log.txt come into it
  Seed seed = 1;
  int threads = 1;
};
// Runs the command on a session and reads what it left in {out}. Throws InputError where a file of the program changed
// since the study was planned; the command fails (with its exit code and the end of its stderr), or does not end
// within its limit; and where what it left cannot be read.
ForeignResult run_foreign_pipeline(const ForeignPipeline& pipeline, const ForeignRequest& request);

}  // namespace dressform
