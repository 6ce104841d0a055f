#include "eval/studies/submit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "eval/run/child_process.h"
#include "eval/studies/plan.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// Two variants on `scenes` drawn scenes, planned.
fs::path planned_for_slurm(const std::string& name, int scenes) {
  const fs::path folder = fs::path(testing::TempDir()) / ("submit_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "study.toml") << "name = \"two of them\"\n[scenes]\n[[scenes.drawn]]\ncount = " << scenes
                                       << "\n[[primary]]\nmetric = \"surface <slot>/f_5mm@1\"\nmargin = 0.01\n"
                                       << "[[variant]]\n[[variant]]\nname = \"other\"\nset.fuse.voxel_m = 0.003\n";
  plan_study(folder / "study.toml", folder / "study");
  return folder / "study";
}

SubmitRequest request_for(const fs::path& study, double cells_a_task) {
  SubmitRequest request;
  request.study = study;
  request.cell_seconds = 60;
  request.task_minutes = cells_a_task;
  return request;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Submit, EveryMissingCellStandsInOneTask) {
  const fs::path study = planned_for_slurm("whole", 5);
  const auto cells = cells_of(read_plan(study), study);
  std::ofstream(cell_file(study, cells[3].id)) << "{}";
  const SubmitJobs jobs = write_jobs(request_for(study, 3));
  EXPECT_EQ(jobs.cells, 9);
  const auto lines = lines_of(jobs.tasks);
  EXPECT_EQ(static_cast<int>(lines.size()), jobs.task_count);
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                            [&](const std::string& line) { return line.find(cells[i].id) != line.npos; }),
              i == 3 ? 0 : 1);
  EXPECT_EQ(read_file_bytes(jobs.tasks), read_file_bytes(write_jobs(request_for(study, 3)).tasks));
}

TEST(Submit, VariantsOfASceneStayTogether) {
  const fs::path study = planned_for_slurm("together", 4);
  const auto cells = cells_of(read_plan(study), study);
  const auto lines = lines_of(write_jobs(request_for(study, 3)).tasks);
  ASSERT_EQ(lines.size(), 4u);  // three would fit, but the third is half of a scene
  for (std::size_t scene = 0; scene < 4; ++scene)
    for (const auto& cell : cells) EXPECT_EQ(lines[scene].find(cell.id) != std::string::npos, cell.scene == scene);
}

// The scripts as a shell runs them for each index: every line of the tasks once, none beyond the array's size.
TEST(Submit, ArraysStayBelowTheirSizeAndRunEveryLineOnce) {
  const fs::path study = planned_for_slurm("arrays", 5);
  SubmitRequest request = request_for(study, 1);
  request.max_array_size = 4;
  request.program = "echo";
  request.sbatch_lines = {"--partition=long"};
  const SubmitJobs jobs = write_jobs(request);
  ASSERT_EQ(jobs.scripts.size(), 3u);  // 10 = 4 + 4 + 2
  const fs::path folder = study.parent_path();
  std::string printed;
  int left = jobs.task_count;
  for (const auto& script : jobs.scripts) {
    const int count = std::min(4, left);
    left -= count;
    const std::string text = read_file_bytes(script);
    EXPECT_NE(text.find("#SBATCH --array=0-" + std::to_string(count - 1) + "\n"), std::string::npos);
    EXPECT_NE(text.find("#SBATCH --requeue\n"), std::string::npos);
    EXPECT_NE(text.find("#SBATCH --partition=long\n"), std::string::npos);
    for (int index = 0; index < count; ++index) {
      const std::string line = "SLURM_ARRAY_TASK_ID=" + std::to_string(index) + " sh " + shell_word(script.string());
      ASSERT_TRUE(run_child({line, folder, 60, folder / "output.txt", folder / "log.txt"}).good());
      printed += read_file_bytes(folder / "output.txt");
    }
  }
  for (const auto& cell : cells_of(read_plan(study), study)) {
    const auto at = printed.find(cell.id);
    EXPECT_NE(at, std::string::npos);
    EXPECT_EQ(printed.find(cell.id, at + 1), std::string::npos);
  }
}

TEST(Submit, FinishedStudiesAndWrongRequests) {
  const fs::path study = planned_for_slurm("finished", 1);
  SubmitRequest request = request_for(study, 1);
  request.sbatch_lines = {"rm -rf /"};
  EXPECT_THROW(write_jobs(request), InputError);
  request.sbatch_lines = {};
  request.max_array_size = 1;
  EXPECT_THROW(write_jobs(request), InputError);
  for (const auto& cell : cells_of(read_plan(study), study)) std::ofstream(cell_file(study, cell.id)) << "{}";
  const SubmitJobs jobs = write_jobs(request_for(study, 1));
  EXPECT_TRUE(jobs.scripts.empty());
  EXPECT_EQ(jobs.cells, 0);
}

}  // namespace
}  // namespace dressform
