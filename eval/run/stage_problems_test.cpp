#include "eval/run/stage_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/testing/test_meshes.h"

namespace dressform {
namespace {

using testing::HasSubstr;

template <class T>
LazyArtifact<T> held(T value) {
  return {"hash", [value] { return value; }};
}

// What a run of two sensors hands on, stage by stage; each test spoils something.
struct Results {
  Calibrated calibrated;
  Multipath multipath;
  BodyModel naked, user;
  ExtractedViews extracted;
  Registration registration;
  Landmarks landmarks;
  Segmentation segmentation;
  FilledViews filled;
  ClosedGarments closed;
  OpenGarments opened;
  TexturedGarments textured;
  FittedGarments fitted;
  CorrectedGarments corrected;
  bool has_user = true;

  Results() {
    const Mesh mesh = test_meshes::tube(0.2, 0.15, {0, 0, 0}, 0.9, 1.4, 8, 4, false);
    naked.body = user.body = mesh;
    naked.converged = user.converged = true;
    for (const char* sensor : {"k1", "k2"}) {
      extracted.views[sensor].found_naked = extracted.views[sensor].found_dressed = true;
      registration.model_from_sensor[sensor] = Isometry3d::Identity();
      registration.converged[sensor] = true;
      segmentation.labels[sensor] = cv::Mat(4, 4, CV_8U, cv::Scalar(2));
      segmentation.labels[sensor].row(3) = 3;
    }
    for (const char* slot : {"top", "bottom"}) {
      filled.garments[slot]["k1"] = {};
      closed.garments[slot].mesh = mesh;
      opened.garments[slot].mesh = mesh;
      for (auto* garments : {&textured.garments, &fitted.garments, &corrected.garments}) (*garments)[slot].mesh = mesh;
      corrected.converged[slot] = true;
    }
  }

  Reconstruction made() const {
    Reconstruction result{{"k1", "k2"},
                          held(calibrated),
                          held(calibrated.calibration),
                          held(multipath),
                          held(naked),
                          held(extracted),
                          held(registration),
                          held(landmarks),
                          held(segmentation),
                          held(filled),
                          held(closed),
                          held(opened),
                          held(textured),
                          {},
                          {},
                          {},
                          {},
                          {}};
    if (!has_user) return result;
    result.user = held(user);
    result.fitted = held(fitted);
    result.corrected = held(corrected);
    return result;
  }
  std::vector<StageProblem> problems() const { return stage_problems(made()); }
};

TEST(StageProblems, AGoodRunHasNone) {
  Results results;
  EXPECT_TRUE(results.problems().empty());
  results.has_user = false;
  EXPECT_TRUE(results.problems().empty()) << "without a user nothing is to be fitted";
}

TEST(StageProblems, EveryStageThatLosesAGarmentIsNamed) {
  const std::vector<std::pair<std::string, std::function<void(Results&)>>> losses{
      {"fill", [](Results& r) { r.filled.garments.erase("top"); }},
      {"surface", [](Results& r) { r.closed.garments.at("top").mesh = {}; }},
      {"open", [](Results& r) { r.opened.garments.erase("top"); }},
      {"texture", [](Results& r) { r.textured.garments.erase("top"); }},
      {"fit", [](Results& r) { r.fitted.garments.erase("top"); }},
      {"correct", [](Results& r) { r.corrected.garments.erase("top"); }}};
  for (std::size_t first = 0; first < losses.size(); ++first) {
    Results results;
    for (std::size_t k = first; k < losses.size(); ++k) losses[k].second(results);  // what is lost stays lost
    const auto problems = results.problems();
    ASSERT_EQ(problems.size(), 1u) << losses[first].first;
    EXPECT_EQ(problems[0].stage, losses[first].first);
    EXPECT_EQ(problems[0].slot, "top");
    EXPECT_TRUE(garments_missing(problems));
  }
}

TEST(StageProblems, TheReasonIsTheStagesOwnWhereItGivesOne) {
  Results results;
  results.opened.garments.erase("top");
  results.opened.failed["top"] = "two loops where the neck is";
  for (auto* garments : {&results.textured.garments, &results.fitted.garments, &results.corrected.garments})
    garments->erase("top");
  ASSERT_EQ(results.problems().size(), 1u);
  EXPECT_EQ(results.problems()[0].text(), "open: the top was not cut open: two loops where the neck is");
}

TEST(StageProblems, NoGarmentAtAll) {
  Results results;
  for (auto& [sensor, labels] : results.segmentation.labels) labels.setTo(1);
  results.filled = {};
  results.closed = {};
  results.opened = {};
  results.textured = {};
  results.fitted = {};
  results.corrected = {};
  const auto problems = results.problems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].text(), "segment: found no garment in 2 registered views");
  EXPECT_TRUE(garments_missing(problems));
  EXPECT_EQ(with_unfound_garments(problems, results.made(), {"bottom", "top"}).size(), 1u) << "said already";
}

TEST(StageProblems, AGarmentThatTheTruthKnowsAndNobodyFound) {
  Results results;
  for (auto& [sensor, labels] : results.segmentation.labels) labels.setTo(2);
  results.filled.garments.erase("bottom");
  results.closed.garments.erase("bottom");
  results.opened.garments.erase("bottom");
  for (auto* garments : {&results.textured.garments, &results.fitted.garments, &results.corrected.garments})
    garments->erase("bottom");
  EXPECT_TRUE(results.problems().empty()) << "a pipeline alone can't know";
  const auto problems = with_unfound_garments(results.problems(), results.made(), {"bottom", "top"});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].text(), HasSubstr("segment: did not find the bottom"));
  EXPECT_TRUE(garments_missing(problems));
}

TEST(StageProblems, WhatDidNotConvergeIsToldAndLosesNothing) {
  Results results;
  results.naked.converged = false;
  results.user.body = {};
  results.extracted.views.at("k2").found_dressed = false;
  results.registration.converged["k2"] = false;
  results.registration.inliers["k2"] = 120;
  results.registration.problem["k2"] = "its residual is 7.2 times the noise";
  results.corrected.converged["top"] = false;
  results.corrected.intersecting_pairs["top"] = 7;
  results.calibrated.boards["k1"] = {};
  const auto problems = results.problems();
  std::vector<std::string> texts;
  for (const auto& problem : problems) texts.push_back(problem.text());
  ASSERT_EQ(texts.size(), 6u);
  EXPECT_THAT(texts[0], HasSubstr("calibrate: k1 did not converge on its boards"));
  EXPECT_THAT(texts[1], HasSubstr("fuse_naked: did not converge"));
  EXPECT_THAT(texts[2], HasSubstr("extract: found no mannequin in k2's shot of the dressed one"));
  EXPECT_THAT(texts[3], HasSubstr("registration: k2 was not registered: its residual is 7.2 times the noise"));
  EXPECT_THAT(texts[4], HasSubstr("fuse_user: made no body"));
  EXPECT_THAT(texts[5], HasSubstr("correct: the top still cuts the body in 7 pairs"));
  EXPECT_FALSE(garments_missing(problems));
  const auto again = problems_from_json(to_json(problems));
  ASSERT_EQ(again.size(), problems.size());
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_EQ(again[i].text(), texts[i]);
}

}  // namespace
}  // namespace dressform
