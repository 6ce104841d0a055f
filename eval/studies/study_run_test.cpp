// Studies of mock cells: what is promised of a study's folder, whatever the pipeline gives.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "eval/studies/merge.h"
#include "eval/studies/run_cells.h"
#include "eval/studies/study_report.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/random.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

const Signature kSignature{{"code", "one"}, {"dressform", "0"}};

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("study_" + name);
  fs::remove_all(folder);
  return folder;
}

// A study on drawn scenes: the default, the same again, one that is better and one that fails on every third scene.
fs::path planned(const std::string& name, int scenes, int seeds = 1) {
  const fs::path file = fs::path(testing::TempDir()) / "mock_study.toml";
  std::ofstream(file) << "name = \"mock\"\nscale = 0.4\nseeds = ["
                      << std::string("1, 2, 3, 4").substr(0, static_cast<std::size_t>(3 * seeds - 2)) << "]\n"
                      << "secondary = [\"open <slot>/rims_hd95_mm@1\"]\n[scenes]\n[[scenes.drawn]]\ncount = " << scenes
                      << "\n[[primary]]\nmetric = \"surface <slot>/f_5mm@1\"\nmargin = 0.01\n"
                      << "[[variant]]\nname = \"default\"\n[[variant]]\nname = \"again\"\n"
                      << "[[variant]]\nname = \"better\"\nset.fuse.voxel_m = 0.003\n"
                      << "[[variant]]\nname = \"failing\"\nset.fuse.voxel_m = 0.006\n";
  const fs::path folder = fresh_folder(name);
  plan_study(file, folder);
  return folder;
}

MadeCell mock_cell(const StudyPlan& plan, const PlannedCell& cell, const fs::path& work) {
  const std::string& variant = plan.study.variants[cell.variant].name;
  std::ofstream(work / "left behind") << "by the run";
  if (variant == "failing" && cell.scene % 3 == 0) throw InputError((work / "out").string(), "has no clothes");
  const double value =
      0.8 + 0.05 * normal(cell.scene, stream_of("mock scene"), 0) + (variant == "better" ? 0.05 : 0) +
      0.005 * normal(cell.seed, stream_of(variant == "again" ? "default" : variant.c_str()), cell.scene);
  MadeCell made;
  made.result.scores = {{"surface", "top/f_5mm@1", "1", value, "ok", 10},
                        {"surface", "bottom/f_5mm@1", "1", value - 0.1, "ok", 10},
                        {"open", "top/rims_hd95_mm@1", "mm", 20 - value, "ok", 4}};
  made.cost.stage_seconds = {{"fuse", 1.0 + cell.scene}};
  return made;
}

RunCellsSummary run_mock(const fs::path& folder, const std::vector<std::string>& only = {},
                         const MakeCell& make = mock_cell) {
  return run_cells(read_plan(folder), {folder, only, kSignature}, make);
}

std::map<std::string, std::string> cell_bytes(const fs::path& folder) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::directory_iterator(folder / "cells"))
    if (entry.path().extension() == ".json")  // not what a killed writer left half-written
      bytes[entry.path().filename().string()] = read_file_bytes(entry.path());
  return bytes;
}

StudyReport report_of(const fs::path& folder, bool seconds = true) {
  const StudyResults results = read_results(folder);
  return study_report(results, compare_variants(results), seconds);
}

std::size_t cell_count(const fs::path& folder) { return cell_bytes(folder).size(); }

std::string report_bytes(const fs::path& folder) {
  std::string bytes;
  for (const auto& file : write_study_report(folder, false).files) bytes += read_file_bytes(file);
  return bytes;
}

TEST(StudyRun, PlanHoldsScenesAndIsPlannedOnce) {
  const fs::path folder = planned("plan", 3);
  const std::string before = read_file_bytes(folder / "study.json");
  EXPECT_TRUE(fs::exists(folder / "scenes/drawn1.toml"));
  const StudyPlan plan = plan_study(folder / "study.toml", folder);  // again, from its own copy
  EXPECT_EQ(read_file_bytes(folder / "study.json"), before);
  EXPECT_EQ(plan.scenes.size(), 3u);
  const fs::path other = fs::path(testing::TempDir()) / "mock_study.toml";
  std::ofstream(other, std::ios::app) << "[[variant]]\nname = \"ideal\"\nsensor = \"ideal\"\n";
  EXPECT_THROW(plan_study(other, folder), InputError);
  EXPECT_EQ(read_file_bytes(folder / "study.json"), before);
  EXPECT_THROW(read_plan(fresh_folder("nothing")), InputError);
}

TEST(StudyRun, ARigOfSeveralFilesCannotBeKept) {
  planned("rigs", 1);
  const fs::path folder = testing::TempDir(), file = folder / "mock_study.toml";
  const fs::path library = fs::path(DRESSFORM_SOURCE_DIR) / "scenes/library/rigs/ring3.toml";
  const auto plan_with = [&](const std::string& rig) {
    const fs::path copy = folder / "rig_study.toml";
    write_file_atomically(copy, read_file_bytes(file) + "[[variant]]\nname = \"rig\"\nrig = \"" + rig + "\"\n");
    return plan_study(copy, fresh_folder("rigs_planned"));
  };
  std::ofstream(folder / "outer_rig.toml") << "file = \"" << library.string() << "\"\n";
  EXPECT_THROW(plan_with((folder / "outer_rig.toml").string()), InputError);
  EXPECT_EQ(plan_with(library.string()).study.variants.back().rig.parent_path(), "rigs");
}

TEST(StudyRun, FinishedStudyDoesNothing) {
  const fs::path folder = planned("finished", 3, 2);
  const RunCellsSummary first = run_mock(folder), second = run_mock(folder);
  EXPECT_EQ(first.made, 3 * 2 * 3);  // two of the four variants ask for the same
  EXPECT_EQ(first.failed, 2);
  EXPECT_EQ(second.made, 0);
  EXPECT_EQ(second.present, first.made);
  EXPECT_TRUE(fs::is_empty(folder / "work"));
}

TEST(StudyRun, AFailedCellIsARowWithItsReason) {
  const fs::path folder = planned("failed", 1);
  run_mock(folder);
  const std::string report = report_bytes(folder);
  EXPECT_NE(report.find("&lt;run&gt;/out: has no clothes"), std::string::npos);  // of no machine in particular
  RunCellsRequest request{folder, {}, kSignature};
  request.retry_failed = true;
  EXPECT_EQ(run_cells(read_plan(folder), request, mock_cell).made, 1);
}

TEST(StudyRun, KeptRunsLieUnderTheirCellsNames) {
  const fs::path folder = planned("kept", 2);
  RunCellsRequest request{folder, {}, kSignature};
  request.keep_work = true;
  run_cells(read_plan(folder), request, mock_cell);
  for (int again = 0; again < 2; ++again) {  // the next run leaves them there
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder / "work")) {
      EXPECT_TRUE(fs::exists(cell_file(folder, entry.path().filename().string()))) << entry.path();
      EXPECT_TRUE(fs::exists(entry.path() / "left behind"));
      ++count;
    }
    EXPECT_EQ(count, cell_count(folder));
    run_mock(folder);
  }
}

TEST(StudyRun, OrderAndSharesChangeNothing) {
  const fs::path one = planned("order_one", 6, 2), other = planned("order_other", 6, 2);
  run_mock(one);
  auto cells = cells_of(read_plan(other), other);
  for (auto cell = cells.rbegin(); cell != cells.rend(); ++cell) run_mock(other, {cell->id});
  EXPECT_EQ(cell_bytes(one), cell_bytes(other));
  EXPECT_EQ(report_bytes(one), report_bytes(other));
}

// A process that makes the study's cells, half a millisecond each.
pid_t child_that_runs(const fs::path& folder) {
  const pid_t child = fork();
  if (child != 0) return child;
  run_mock(folder, {}, [](const StudyPlan& plan, const PlannedCell& cell, const fs::path& work) {
    usleep(500);
    return mock_cell(plan, cell, work);
  });
  _exit(0);
}

TEST(StudyRun, KilledFiveTimesAndByTwoProcessesItEndsWithTheSameBytes) {
  const int scenes = 18, seeds = 4;  // 216 cells
  const fs::path whole = planned("whole", scenes, seeds), killed = planned("killed", scenes, seeds);
  run_mock(whole);
  for (std::size_t round = 1; round <= 5; ++round) {
    const pid_t child = child_that_runs(killed);
    while (cell_count(killed) < 10 * round && waitpid(child, nullptr, WNOHANG) == 0) usleep(200);
    ASSERT_EQ(kill(child, SIGKILL), 0) << "it ended by itself";
    waitpid(child, nullptr, 0);
  }
  EXPECT_LT(cell_count(killed), 216u);
  const pid_t first = child_that_runs(killed), second = child_that_runs(killed);
  for (const pid_t child : {first, second}) {
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(cell_bytes(whole), cell_bytes(killed));
  EXPECT_EQ(report_bytes(whole), report_bytes(killed));
  run_mock(killed);
  EXPECT_TRUE(fs::is_empty(killed / "work"));  // what the killed ones left is gone
}

TEST(StudyRun, NumbersOfDifferentProgramsAreNotCompared) {
  const fs::path folder = planned("signature", 2);
  run_mock(folder);
  RunCellsRequest request{folder, {}, {{"code", "two"}, {"dressform", "0"}}};
  const StudyPlan plan = read_plan(folder);
  EXPECT_THROW(run_cells(plan, request, mock_cell), InputError);
  const std::string id = cells_of(plan, folder).front().id;
  CellResult other = read_cell(cell_file(folder, id));
  other.signature["code"] = "two";
  write_file_atomically(cell_file(folder, id), cell_json(other));
  try {
    read_results(folder);
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("code one and two"), std::string::npos) << error.what();
  }
  RunCellsRequest renewed{folder, {}, kSignature};
  renewed.renew = true;
  EXPECT_EQ(run_cells(plan, renewed, mock_cell).made, 1);
  EXPECT_NO_THROW(read_results(folder));
}

TEST(StudyRun, SignatureNamesAllThatNumbersDependOn) {
  Signature own = program_signature();
  for (const char* name : {"dressform", "commit", "code", "metrics", "compiler", "opencv", "open3d", "embree"})
    EXPECT_FALSE(own[name].empty()) << name;
  Signature other = own;
  other["commit"] = "another";
  EXPECT_EQ(difference_of(own, other), "");  // of the same code
  other["open3d"] = "0.0.0";
  EXPECT_EQ(difference_of(own, other), "open3d " + own["open3d"] + " and 0.0.0");
}

TEST(StudyRun, DamagedCellsAreNamed) {
  const fs::path folder = planned("damaged", 2);
  EXPECT_THROW(read_results(folder), InputError);  // nothing there yet
  run_mock(folder);
  const fs::path file = cell_file(folder, cells_of(read_plan(folder), folder).front().id);
  write_file_atomically(file, read_file_bytes(file).substr(0, 100));
  EXPECT_THROW(read_results(folder), InputError);
  EXPECT_THROW(run_mock(folder, {"no such cell"}), InputError);
}

TEST(StudyRun, MergedStudiesAreTheWhole) {
  const fs::path whole = planned("merge_whole", 4), left = planned("merge_left", 4), right = planned("merge_right", 4);
  run_mock(whole);
  for (const auto& cell : cells_of(read_plan(left), left)) run_mock(cell.scene < 2 ? left : right, {cell.id});
  const MergeSummary summary = merge_studies(left, {right});
  EXPECT_EQ(summary.taken, 6);
  EXPECT_EQ(cell_bytes(whole), cell_bytes(left));
  EXPECT_EQ(report_bytes(whole), report_bytes(left));
  EXPECT_THROW(merge_studies(left, {planned("merge_other", 5)}), InputError);
  const fs::path file = cell_file(right, cells_of(read_plan(right), right).back().id);
  CellResult changed = read_cell(file);
  changed.reason += "!";
  write_file_atomically(file, cell_json(changed));
  EXPECT_THROW(merge_studies(left, {right}), InputError);
}

TEST(StudyRun, AnotherCommitOfTheSameCodeIsNoOtherProgram) {
  const fs::path left = planned("commit_left", 2), right = planned("commit_right", 2);
  for (const auto& [folder, commit] : {std::pair(left, "1a"), std::pair(right, "2b")}) {
    RunCellsRequest request{folder, {}, kSignature};
    request.signature["commit"] = commit;
    run_cells(read_plan(folder), request, mock_cell);
  }
  EXPECT_EQ(merge_studies(left, {right}).taken, 0);  // the same numbers
  const auto cells = cells_of(read_plan(left), left);
  write_file_atomically(cell_file(left, cells[0].id), read_file_bytes(cell_file(right, cells[0].id)));
  EXPECT_EQ(read_results(left).signature.at("commit"), "1a and 2b");
}

TEST(StudyReport, TwelveScenesTellFourDoNot) {
  const fs::path twelve = planned("twelve", 12), four = planned("four", 4);
  for (const auto& folder : {twelve, four}) run_mock(folder);
  const std::string headline = report_of(twelve).headline;
  EXPECT_EQ(headline, "surface <slot>/f_5mm@1 against default: better better; worse failing; equivalent again");
  EXPECT_EQ(report_of(four).headline, "surface <slot>/f_5mm@1 against default: inconclusive better, again, failing");
  EXPECT_NE(report_markdown(report_of(four)).find("Fewer than 6 scenes"), std::string::npos);
}

TEST(StudyReport, FailuresShowThreeTimes) {
  const fs::path folder = planned("three_ways", 12);
  run_mock(folder);
  const std::string text = report_markdown(report_of(folder));
  EXPECT_NE(text.find("8 of 12"), std::string::npos);                     // success rate
  EXPECT_NE(text.find("better 3, worse 9, equal 0"), std::string::npos);  // with failures as the worst rank
  EXPECT_NE(text.find("has no clothes"), std::string::npos);
}

TEST(StudyReport, FetchesNothingAndSaysSecondsOnlyWhereAsked) {
  const fs::path folder = planned("html", 6);
  run_mock(folder);
  const std::string with = report_html(report_of(folder)), without = report_html(report_of(folder, false));
  EXPECT_EQ(with.find("http://"), with.find("http://www.w3.org/2000/svg"));  // a name of a format, not an address
  EXPECT_EQ(with.find("https://"), std::string::npos);
  EXPECT_EQ(with.find("<script"), std::string::npos);
  EXPECT_NE(with.find("of baseline"), std::string::npos);
  EXPECT_EQ(without.find("of baseline"), std::string::npos);
  const std::string csv = results_csv(read_results(folder));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 * 6 * 2);  // variants, scenes, metrics
}

}  // namespace
}  // namespace dressform
