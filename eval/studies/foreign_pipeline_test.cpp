#include "eval/studies/foreign_pipeline.h"

#include <gtest/gtest.h>

#include <fstream>

#include "eval/studies/make_cell.h"
#include "eval/studies/plan.h"
#include "eval/studies/study.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

fs::path fresh_place(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("foreign_pipeline_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

// A study of one drawn scene with these variants.
Study study_with(const fs::path& folder, const std::string& variants) {
  std::ofstream(folder / "study.toml") << "[scenes]\n[[scenes.drawn]]\ncount = 1\n[[primary]]\n"
                                       << "metric = \"surface <slot>/f_5mm@1\"\nmargin = 0.01\n"
                                       << variants;
  return read_study(folder / "study.toml");
}

void expect_wrong(const std::string& variants, const std::string& what) {
  try {
    study_with(fresh_place("wrong"), variants);
    FAIL() << "expected an InputError with " << what;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
  }
}

// A capture session as far as a command sees it.
fs::path session_in(const fs::path& folder) {
  fs::create_directories(folder / "captured/truth");
  std::ofstream(folder / "captured/session.json") << "{}";
  std::ofstream(folder / "captured/truth/secret") << "poses";
  return folder / "captured";
}

// Leaves one score: the seed.
const char* const kScores =
    R"(printf '{"format": "dressform-scores", "version": 1, "scores": [{"stage": "surface", "metric": )"
    R"("top/f_5mm@1", "unit": "1", "value": 0.%s}]}' {seed} > {out}/scores.json)";

ForeignResult run_command(const fs::path& folder, const std::string& command, double limit_s = 60) {
  ForeignPipeline pipeline;
  pipeline.command = command;
  pipeline.limit_s = limit_s;
  pipeline.folder = folder;
  fs::create_directories(folder / "work");
  return run_foreign_pipeline(pipeline, {session_in(folder), folder / "work", 7, 1});
}

std::string failure_of(const std::string& command, double limit_s = 60) {
  try {
    run_command(fresh_place("failing"), command, limit_s);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(ForeignPipeline, GetsACaptureAndLeavesScores) {
  const fs::path folder = fresh_place("scores");
  const ForeignResult result = run_command(folder, std::string("test -f {session}/session.json && ") + kScores);
  ASSERT_EQ(result.scores.rows.size(), 1u);
  EXPECT_EQ(result.scores.rows[0].value, 0.7);
  EXPECT_GT(result.seconds, 0);
}

TEST(ForeignPipeline, DoesNotSeeTheTruth) {
  EXPECT_NO_THROW(run_command(fresh_place("truth"), std::string("test ! -e {session}/truth && ") + kScores));
}

TEST(ForeignPipeline, FailsWithItsReason) {
  EXPECT_EQ(failure_of("echo step 1 >&2; echo 'no clothes found' >&2; exit 3; : {out}"),
            "command: found exit code 3: step 1 | no clothes found; expected exit code 0 within 60 s");
  EXPECT_NE(failure_of("sleep 100; : {out}", 0.1).find("no end after 0.1 s"), std::string::npos);
  EXPECT_NE(failure_of("printf '\\377\\n' >&2; exit 1; : {out}").find("exit code 1"), std::string::npos);
  EXPECT_NE(failure_of("true {out}").find("neither registration.json nor scores.json"), std::string::npos);
}

TEST(ForeignPipeline, StandsInAStudyBesideOurs) {
  const Study mixed = study_with(fresh_place("mixed"), R"(
[[variant]]
name = "default"
[variant.mine]
command = "python3 {folder}/mine.py {session} {out} ${HOME}"
limit_s = 60
[[variant]]
name = "theirs"
command = "theirs {session} {out} --seed {seed}"
sensor = "ideal"
)");
  ASSERT_EQ(mixed.variants.size(), 3u);
  EXPECT_FALSE(mixed.variants[0].foreign);
  EXPECT_EQ(mixed.variants[1].name, "mine");
  EXPECT_EQ(mixed.variants[1].foreign->limit_s, 60);
  EXPECT_EQ(mixed.variants[2].sensor.variant, "ideal");
  const Study named = study_with(fresh_place("named"), R"(
[variant.default]
[variant.mine]
command = "mine {session} {out}"
)");
  ASSERT_EQ(named.variants.size(), 2u);
}

TEST(ForeignPipeline, WrongOnesAreNamed) {
  const std::string start = "[[variant]]\nname = \"default\"\n[variant.mine]\n";
  expect_wrong(start + "command = \"mine {session}\"", "found no {out}");
  expect_wrong(start + "command = \"mine {capture} {out}\"", "found {capture}; expected one of {session}");
  expect_wrong(start + "command = \"mine {out}\"\nfiles = [\"nowhere.py\"]", "nowhere.py");
  expect_wrong(start + "command = \"mine {out}\"\nstages = {surface = \"poisson\"}", "found it beside");
  expect_wrong("[[variant]]\nlimit_s = 3\n[[variant]]\nname = \"b\"", "without a command");
}

TEST(ForeignPipeline, AChangeOfTheProgramIsAnotherVariant) {
  const fs::path folder = fresh_place("files");
  const auto ids = [&](const std::string& program, const std::string& into) {
    std::ofstream(folder / "mine.py") << program;
    study_with(folder,
               "[[variant]]\nname = \"default\"\n[variant.mine]\ncommand = \"sh mine.py {out}\"\n"
               "files = [\"mine.py\"]\n");
    const StudyPlan plan = plan_study(folder / "study.toml", folder / into);
    std::vector<std::string> result;
    for (const auto& cell : cells_of(read_plan(folder / into), folder / into)) result.push_back(cell.id);
    return result;
  };
  const auto first = ids("1", "one"), again = ids("1", "again"), changed = ids("2", "two");
  EXPECT_EQ(first, again);
  EXPECT_EQ(first[0], changed[0]);
  EXPECT_NE(first[1], changed[1]);
  const StudyPlan plan = read_plan(folder / "one");  // whose program is another one by now
  fs::create_directories(folder / "work");
  EXPECT_THROW(run_foreign_pipeline(*plan.study.variants[1].foreign, {session_in(folder), folder / "work", 1, 1}),
               InputError);
}

}  // namespace
}  // namespace dressform
