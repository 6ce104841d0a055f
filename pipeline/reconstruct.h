#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pipeline/correct/correct.h"
#include "pipeline/texture/texture.h"
#include "pipeline/calibrate/calibrate.h"

namespace dressform {

// Which variant of each stage, with what parameters. Stages that are not named run their default variant.
struct ReconstructionOptions {
  std::map<std::string, std::string> variants;  // stage -> variant
  std::map<std::string, FieldValues> values;    // stage -> parameter -> value
  Seed seed = 1;
};

// What one stage did in this run.
struct StageRecord {
  int number = 0;
  std::string stage, variant, key, folder;  // folder: of the artifact in the store
  FieldValues values;                       // all parameters, defaults included
  double seconds = 0;                       // of the run that made the artifact
  double peak_memory_mb = 0;
  bool reused = false;
};

// Everything the road makes, in its order.
struct Reconstruction {
  std::vector<std::string> sensors;
  Calibration calibration;
  BodyModel naked, user;
  ExtractedViews extracted;
  Registration registration;
  Segmentation segmentation;
  FilledViews filled;
  ClosedGarments closed;
  OpenGarments opened;
  TexturedGarments textured;
  FittedGarments fitted;
  CorrectedGarments corrected;
  std::vector<StageRecord> records;
};

}  // namespace dressform
