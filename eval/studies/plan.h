#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "eval/studies/study.h"

namespace dressform {

// A scene of a study, or a recording. Drawn scenes lie in the study's own folder.
struct PlannedScene {
  std::string name;
  bool recording = false;
  std::filesystem::path path;  // relative to the study's folder where it lies there
  std::string content_hash;    // of the scene with all files it refers to, or of the session
  std::vector<std::string> strata;
};

// A study with its scenes drawn and its variants told one by one: what study.json in its folder holds. No command needs
// the study file again, so that variants registered later do not change what was planned.
struct StudyPlan {
  Study study;  // scenes, recordings and drawn ranges are empty: see `scenes`
  std::vector<PlannedScene> scenes;
};

struct PlannedCell {
  std::string id;
  std::size_t scene = 0;
  Seed seed = 1;
  std::size_t variant = 0;
};

// Plans the study into a new folder: study.json, study.toml as written, and scenes/. The same study planned again
// changes nothing. Throws InputError when the folder holds something else.
StudyPlan plan_study(const std::filesystem::path& study_file, const std::filesystem::path& folder);
// The same of a study that no file holds; `as_written`: what stands in study.toml for people.
StudyPlan plan_study(Study study, const std::string& as_written, const std::filesystem::path& folder);

// Throws InputError naming the folder or file when there is no intact plan.
StudyPlan read_plan(const std::filesystem::path& folder);

// All cells: scene by scene, seed by seed, so that variants that follow one another share their upstream work.
// Two variants that ask for the same are one cell, with one id.
std::vector<PlannedCell> cells_of(const StudyPlan& plan, const std::filesystem::path& folder);

// Of the cell's cameras: the variant's, or the study's.
double scale_of(const StudyPlan& plan, const PlannedCell& cell);

std::filesystem::path cell_file(const std::filesystem::path& folder, const std::string& id);
std::filesystem::path cost_file(const std::filesystem::path& folder, const std::string& id);

}  // namespace dressform
