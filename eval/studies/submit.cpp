#include "eval/studies/submit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "eval/run/child_process.h"
#include "eval/studies/cell.h"
#include "eval/studies/plan.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// A command is one argument of sh -c, of which Linux takes 128 KiB; a cell adds some 28 bytes.
constexpr std::size_t kMostCellsOfTask = 2000;
constexpr std::size_t kJobDigits = 8;  // of the hash that tells one submission's files from another's

std::vector<PlannedCell> cells_left(const StudyPlan& plan, const fs::path& study) {
  std::vector<PlannedCell> left;
  std::set<std::string> seen;
  for (const auto& cell : cells_of(plan, study))
    if (seen.insert(cell.id).second && !fs::exists(cell_file(study, cell.id))) left.push_back(cell);
  return left;
}

// Mean over the cells that are there, their captures not counted: those of a scene share one.
double seconds_of_cell(const SubmitRequest& request, const StudyPlan& plan) {
  if (request.cell_seconds > 0) return request.cell_seconds;
  double sum = 0;
  int count = 0;
  for (const auto& cell : cells_of(plan, request.study))
    if (const auto cost = read_cost(cost_file(request.study, cell.id)); cost && !cost->stage_seconds.empty())
      sum += cost->pipeline_seconds(), ++count;
  return count == 0 ? kUsualCellSeconds : std::max(sum / count, 1e-3);
}

// Consecutive cells, a new task where the time is up, or where another scene begins and would not fit.
std::vector<std::vector<std::string>> shared_out(const std::vector<PlannedCell>& cells, std::size_t most) {
  std::vector<std::vector<std::string>> tasks;
  for (std::size_t i = 0; i < cells.size();) {
    std::size_t end = i;
    while (end < cells.size() && cells[end].scene == cells[i].scene && cells[end].seed == cells[i].seed) ++end;
    for (; i < end; ++i) {
      const bool first_of_group = i == 0 || cells[i].scene != cells[i - 1].scene || cells[i].seed != cells[i - 1].seed;
      const std::size_t needed = first_of_group ? std::min(end - i, most) : 1;
      if (tasks.empty() || tasks.back().size() + needed > most) tasks.emplace_back();
      tasks.back().push_back(cells[i].id);
    }
  }
  return tasks;
}

std::string job_name(const std::string& study) {
  std::string name;
  for (const char letter : study) name += std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
  return name;
}

std::string array_script(const SubmitRequest& request, const std::string& name, const fs::path& tasks, int first,
                         int count) {
  const fs::path log = tasks.parent_path() / "log";
  std::string script = fmt::format(
      "#!/bin/sh\n#SBATCH --job-name={}\n#SBATCH --array=0-{}\n#SBATCH --requeue\n#SBATCH --open-mode=append\n"
      "#SBATCH --cpus-per-task={}\n#SBATCH --output={}\n",
      job_name(name), count - 1, request.threads, (log / "%A_%a.txt").string());
  for (const auto& line : request.sbatch_lines) script += "#SBATCH " + line + "\n";
  script += fmt::format(
      "# A task that was killed is begun again: cells that are there are not made twice.\n"
      "line=$((SLURM_ARRAY_TASK_ID + {}))\nexec sh -c \"$(sed -n \"${{line}}p\" {})\"\n",
      first + 1, shell_word(tasks.string()));
  return script;
}

void check_request(const SubmitRequest& request) {
  if (request.max_array_size < 2)
    throw InputError("--max-array-size", fmt::format("found {}; expected 2 at least", request.max_array_size));
  for (const auto& line : request.sbatch_lines)
    if (line.rfind("--", 0) != 0 || line.find('\n') != line.npos)
      throw InputError("--sbatch-line " + line, "expected an option of sbatch, e.g. --partition=long");
  const std::string folder = fs::absolute(request.study).string();
  if (folder.find_first_of(" %\n\"'\\") != folder.npos)  // sbatch reads --output in its own way
    throw InputError(folder, "found a space, %, quote or backslash in the path; expected a study's folder without");
}

}  // namespace

std::string task_command(const SubmitRequest& request, const std::vector<std::string>& cells) {
  std::string line = fmt::format("{} study run {} -q --threads {}", shell_word(request.program),
                                 shell_word(fs::absolute(request.study).string()), request.threads);
  if (!request.store.empty()) line += " --store " + shell_word(fs::absolute(request.store).string());
  for (const auto& cell : cells) line += " --cell " + cell;
  return line;
}

SubmitJobs write_jobs(const SubmitRequest& request) {
  check_request(request);
  const StudyPlan plan = read_plan(request.study);
  const auto left = cells_left(plan, request.study);
  SubmitJobs jobs;
  jobs.cells = static_cast<int>(left.size());
  if (left.empty()) return jobs;
  const double fit = request.task_minutes * 60 / seconds_of_cell(request, plan);
  const auto most = static_cast<std::size_t>(std::clamp(std::floor(fit), 1.0, double(kMostCellsOfTask)));
  std::string commands;
  const auto tasks = shared_out(left, most);
  for (const auto& cells : tasks) commands += task_command(request, cells) + "\n";
  jobs.task_count = static_cast<int>(tasks.size());
  const fs::path folder = fs::absolute(request.study) / "jobs";
  const std::string name = hash_hex(commands).substr(0, kJobDigits);
  fs::create_directories(folder / "log");
  jobs.tasks = folder / (name + ".tasks");
  write_file_atomically(jobs.tasks, commands);
  for (int first = 0; first < jobs.task_count; first += request.max_array_size) {
    const int count = std::min(request.max_array_size, jobs.task_count - first);
    jobs.scripts.push_back(folder / fmt::format("{}-{}.sh", name, jobs.scripts.size() + 1));
    write_file_atomically(jobs.scripts.back(), array_script(request, plan.study.name, jobs.tasks, first, count));
  }
  return jobs;
}

}  // namespace dressform
