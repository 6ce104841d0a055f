#pragma once
#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "eval/gate/bytes.h"
#include "eval/score/scores.h"

namespace dressform {

// A reference that is missing, empty, corrupt or obsolete: exit code 3.
class GoldenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One accepted number with the gate's tolerance: how far another compiler, instruction set, thread count or platform
// may move it. It says nothing about noise seeds.
struct GoldenScore {
  ScoreRow row;
  double tolerance = 0;  // by the metric's declaration when it was accepted; used where no nuisance was measured
  double first = 0;      // the value of the first accept ever; NaN where there was none
  // Worsening since `first` that someone accepted knowingly: the number by its name, or in one step too large to creep.
  double known_drift = 0;
};

// golden/<name>/: golden.json and small images. References of before bytes were kept are read as well: `steps` and
// `environment` are then empty, `first` is the value itself.
struct GoldenCase {
  std::string name;
  std::string scene;  // scene file, relative to the folder that holds golden/
  double scale = 1;
  Seed seed = 1;
  std::vector<GoldenScore> scores;
  std::map<std::string, cv::Mat> images;            // file stem -> 8-bit BGR
  std::map<std::string, double> image_drift;        // file stem -> sum of FLIP over all accepts of another picture
  std::vector<StepBytes> steps;                     // of the run that was accepted whole; empty: none kept
  Environment environment;                          // in which that was made
  std::map<std::string, std::string> known_misses;  // "stage metric" of a target that is missed -> why
  std::vector<std::string> history;                 // why each accept was made, oldest first
};

// How a case is to be run; read even where nothing has been accepted yet. Throws GoldenError naming the file.
GoldenCase read_golden_recipe(const std::filesystem::path& golden, const std::string& name);
// The whole case. Throws GoldenError when anything is missing, empty or corrupt (pixels are hashed).
GoldenCase read_golden_case(const std::filesystem::path& golden, const std::string& name);
void write_golden_case(const std::filesystem::path& golden, const GoldenCase& golden_case);

// Hash of an image's pixels, whatever file it lies in.
std::string pixel_hash(const cv::Mat& image);

// The cases below a golden folder, sorted. Throws GoldenError when there is none.
std::vector<std::string> golden_case_names(const std::filesystem::path& golden);

}  // namespace dressform
