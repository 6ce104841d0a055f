#include "eval/studies/results_index.h"

#include <gtest/gtest.h>

#include "eval/score/scores.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// Two runs, one of them of an older program.
fs::path folder_with_runs() {
  const fs::path folder = fs::path(testing::TempDir()) / "results_index";
  fs::remove_all(folder);
  for (const auto& [name, value] : {std::pair{"first", 0.91}, {"second", 0.93}}) {
    fs::create_directories(folder / "runs" / name);
    const Scores scores{"group1", "default", 1, {{"surface", "top/f_5mm@1", "1", value, "ok", 100}}};
    write_file_atomically(folder / "runs" / name / "scores.json", scores_to_json(scores));
    write_file_atomically(folder / "runs" / name / "run.json",
                          std::string("{\"scale\": 0.4, \"provenance\": {\"commit\": \"") + name + "\"}}");
  }
  return folder;
}

TEST(ResultsIndex, AsksTheFiles) {
  const ResultsIndex index({folder_with_runs()});
  EXPECT_EQ(index.runs(), 2);
  const auto rows =
      index.query("SELECT program, value, scale FROM runs JOIN scores USING (run) WHERE metric = ? ORDER BY value DESC",
                  {"top/f_5mm@1"});
  EXPECT_EQ(rows.columns, (std::vector<std::string>{"program", "value", "scale"}));
  ASSERT_EQ(rows.values.size(), 2u);
  EXPECT_EQ(rows.values[0], (std::vector<std::string>{"second", "0.93", "0.4"}));
}

TEST(ResultsIndex, OnlyReads) {
  const ResultsIndex index({folder_with_runs()});
  EXPECT_THROW(index.query("DROP TABLE runs"), InputError);
  EXPECT_THROW(index.query("SELECT 1; DELETE FROM runs"), InputError);
  EXPECT_THROW(index.query("SELECT nothing FROM runs"), InputError);
  EXPECT_EQ(index.query("SELECT count(*) FROM runs").values[0][0], "2");
}

TEST(ResultsIndex, DamagedFilesAreNamed) {
  const fs::path folder = folder_with_runs();
  write_file_atomically(folder / "runs/first/scores.json", "{");
  EXPECT_THROW(ResultsIndex({folder}), InputError);
  EXPECT_THROW(ResultsIndex({folder / "nowhere"}), InputError);
}

// The nuisance of a part of 1 is 0.01: steps are larger than that, creep is larger only in sum.
TEST(ResultsIndex, StepsAndCreep) {
  std::vector<HistoryPoint> points;
  for (const double value : {0.90, 0.906, 0.912, 0.95, 0.951, 0.943}) points.push_back({"", "", value});
  EXPECT_EQ(changes_of(points, "surface", "top/f_5mm@1"),
            (std::vector<Change>{Change::none, Change::none, Change::creep, Change::step, Change::none, Change::none}));
  EXPECT_THROW(changes_of(points, "surface", "top/f_5@1"), InputError);
}

}  // namespace
}  // namespace dressform
