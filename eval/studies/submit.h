#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dressform {

constexpr int kUsualMaxArraySize = 1001;  // Slurm's own default: array indices from 0 to 1000

// How the missing cells of a study are shared out to a Slurm cluster.
struct SubmitRequest {
  std::filesystem::path study;
  std::string program = "dressform";  // as the nodes find it
  std::filesystem::path store;        // of stage results; empty: the program's own choice
  double task_minutes = 20;           // of cells a task: short against a queue, long against a task's start
  double cell_seconds = 0;            // 0: what the study's cells took so far; without any, kUsualCellSeconds
  int threads = 2;                    // of a task
  int max_array_size = kUsualMaxArraySize;
  std::vector<std::string> sbatch_lines;  // "--partition=long": of one's site, into each script
};
constexpr double kUsualCellSeconds = 60;  // a cell at scale 0.6 on two cores, the capture in the store

// Job scripts, as they lie in STUDY/jobs: `tasks` holds one command a line, the scripts are arrays over its lines.
struct SubmitJobs {
  std::filesystem::path tasks;
  std::vector<std::filesystem::path> scripts;
  int cells = 0, task_count = 0;
};

// Writes them for the cells that are not there yet; none where all are. Cells of one scene and seed, whose variants
// share what lies before them, stay together as far as a task's time goes. The same missing cells give the same files.
SubmitJobs write_jobs(const SubmitRequest& request);

// A command that makes those cells of the study, one after the other.
std::string task_command(const SubmitRequest& request, const std::vector<std::string>& cells);

}  // namespace dressform
