#include "eval/run/foreign_run.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

fs::path fresh_run(const std::string& name) {
  const fs::path run = fs::path(testing::TempDir()) / ("foreign_" + name);
  fs::remove_all(run);
  fs::create_directories(run / "out");
  return run;
}

const char* const kRow = R"({"stage": "surface", "metric": "top/f_5mm@1", "unit": "1", "value": 0.75})";

fs::path run_with_rows(const std::string& name, const std::string& rows) {
  const fs::path run = fresh_run(name);
  std::ofstream(run / "out/scores.json") << R"({"format": "dressform-scores", "version": 1, "scores": [)" << rows
                                         << "]}";
  return run;
}

void expect_refused(const fs::path& run, const std::string& what) {
  try {
    read_foreign_run(run, {});
    FAIL() << "expected an InputError with " << what;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
  }
}

TEST(ForeignRun, TakesTheProgramsOwnScores) {
  const std::string mine =
      R"({"stage": "mine", "metric": "smoothness", "unit": "1", "value": null, "status": "failed"})";
  const ForeignRun run = read_foreign_run(run_with_rows("scores", std::string(kRow) + "," + mine), {});
  EXPECT_FALSE(run.scored_here);
  ASSERT_EQ(run.scores.rows.size(), 2u);
  EXPECT_EQ(run.scores.find("surface", "top/f_5mm@1")->value, 0.75);
  EXPECT_EQ(run.scores.rows[1].status, "failed");
}

TEST(ForeignRun, RefusesWhatCannotBeCompared) {
  expect_refused(fresh_run("empty"), "neither registration.json nor scores.json");
  const fs::path both = run_with_rows("both", kRow);
  std::ofstream(both / "out/registration.json") << "{}";
  expect_refused(both, "both");
  expect_refused(run_with_rows("twice", std::string(kRow) + "," + kRow), "twice");
  expect_refused(run_with_rows("unit", R"({"stage": "surface", "metric": "top/f_5mm@1", "unit": "mm", "value": 1})"),
                 "as `dressform metrics` lists it");
  expect_refused(run_with_rows("null", R"({"stage": "a", "metric": "b", "unit": "1", "value": null})"), "value");
  expect_refused(run_with_rows("status", R"({"stage": "a", "metric": "b", "unit": "1", "status": "good"})"),
                 "expected ok, failed or absent");
  expect_refused(run_with_rows("damaged", "{"), "scores.json");
}

TEST(ForeignRun, LooksAtPictures) {
  const fs::path run = run_with_rows("pictures", kRow);
  fs::create_directories(run / "out/pictures");
  const std::string header("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x10\0\0\0\x08", 24);
  write_file_atomically(run / "out/pictures/b.png", header);
  write_file_atomically(run / "out/pictures/a.png", header);
  const ForeignRun read = read_foreign_run(run, {});
  ASSERT_EQ(read.pictures.size(), 2u);
  EXPECT_EQ(read.pictures[0].filename(), "a.png");
  std::string large = header;
  large[16] = 1;
  write_file_atomically(run / "out/pictures/c.png", large);
  expect_refused(run, "c.png: found 16777232 x 8 pixels");
  write_file_atomically(run / "out/pictures/c.png", "GIF89a");
  expect_refused(run, "c.png: is no PNG");
}

}  // namespace
}  // namespace dressform
