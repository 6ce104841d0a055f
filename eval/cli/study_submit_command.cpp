#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/run/child_process.h"
#include "eval/studies/submit.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kSbatchLimit_s = 300;  // a controller under load answers late

struct SubmitOptions : SubmitRequest {
  std::string sbatch = "sbatch";
  bool dry_run = false;
};

ChildResult asked(const std::string& line, const fs::path& folder, std::string& answer) {
  const fs::path output = folder / "answer.txt", log = folder / "complaint.txt";
  const ChildResult ended = run_child({line, folder, kSbatchLimit_s, output, log});
  answer = read_file_bytes(output);
  fs::remove(output), fs::remove(log);
  return ended;
}

// What the cluster allows; Slurm's default where it cannot be asked.
int asked_max_array_size(const fs::path& study) {
  std::string answer;
  const auto ended = asked("scontrol show config | sed -n 's/^MaxArraySize *= *//p'", study, answer);
  const int found = ended.good() ? std::atoi(answer.c_str()) : 0;
  return found >= 2 ? found : kUsualMaxArraySize;
}

int submit(SubmitOptions options) {
  if (!fs::exists(options.study / "study.json"))
    throw InputError(options.study.string(), "holds no study.json; expected a folder made by `dressform study new`");
  if (options.max_array_size == 0) options.max_array_size = asked_max_array_size(options.study);
  if (options.program.empty()) options.program = fs::read_symlink("/proc/self/exe").string();
  const SubmitJobs jobs = write_jobs(options);
  if (jobs.cells == 0) {
    fmt::print("nothing to do: all cells are there\n");
    return kSuccess;
  }
  fmt::print("{} cells in {} tasks: {}\n", jobs.cells, jobs.task_count, jobs.tasks.string());
  for (const auto& script : jobs.scripts) {
    if (options.dry_run) {
      fmt::print("{}\n", script.string());
      continue;
    }
    std::string answer;
    const auto ended = asked(options.sbatch + " " + shell_word(script.string()), options.study, answer);
    if (!ended.good())
      throw InputError(options.sbatch + " " + script.string(),
                       fmt::format("found {}: {}; expected the job to be taken (the scripts stay: they can be given to "
                                   "sbatch by hand)",
                                   ended.end_text(), ended.complaint));
    fmt::print("{}", answer);
  }
  fmt::print("next: squeue; dressform study status {}; what is missing in the end is submitted by the same command\n",
             options.study.string());
  return kSuccess;
}

Command add_study_submit_command(CLI::App& study) {
  auto options = std::make_shared<SubmitOptions>();
  options->max_array_size = 0;
  options->program.clear();
  auto* command =
      study.add_subcommand("submit", "Write Slurm job scripts for the cells that are missing, and submit them");
  command->add_option("study", options->study, "folder made by `study new`, which all nodes see")->required();
  command->add_option("--task-minutes", options->task_minutes, "of cells a task (20)")->check(CLI::PositiveNumber);
  command
      ->add_option("--cell-seconds", options->cell_seconds,
                   "what a cell takes; default: what those took that are there, else 60")
      ->check(CLI::PositiveNumber);
  command->add_option("--threads", options->threads, "of a task (2)")->check(CLI::Range(1, 1024));
  command->add_option("--store", options->store, "where stage results are shared, on all nodes");
  command->add_option("--program", options->program, "dressform as the nodes find it; default: this one's path");
  command->add_option("--max-array-size", options->max_array_size, "default: what scontrol says, else 1001");
  command->add_option("--sbatch-line", options->sbatch_lines, "an #SBATCH option of your site (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--sbatch", options->sbatch, "the command that takes a script (sbatch)");
  command->add_flag("--dry-run", options->dry_run, "write the scripts, submit nothing");
  command->footer(
      "Example:\n  dressform study submit /shared/study --store /shared/store --sbatch-line=--partition=long");
  return [options] { return submit(*options); };
}

const RegisteredStudyCommand registered_study_submit{10, add_study_submit_command};

}  // namespace
}  // namespace dressform
