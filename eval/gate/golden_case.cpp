#include "eval/gate/golden_case.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "pipeline/run/artifact_store.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read_golden_json(const fs::path& golden, const std::string& name) {
  const fs::path file = golden / name / "golden.json";
  std::ifstream in(file);
  if (!in) throw GoldenError(file.string() + ": missing; expected the reference of case " + name);
  json text = json::parse(in, nullptr, false);
  if (!text.is_object() || text.value("format", "") != "dressform-golden")
    throw GoldenError(file.string() + ": corrupt; expected JSON of format dressform-golden");
  if (text.value("version", 0) != 1) throw GoldenError(file.string() + ": obsolete; expected version 1");
  return text;
}

GoldenScore score_from(const json& row) {
  GoldenScore score;  // member by member: a complaint half way leaves nothing half made
  score.row.stage = row.at("stage").get<std::string>();
  score.row.metric = row.at("metric").get<std::string>();
  score.row.unit = row.at("unit").get<std::string>();
  score.row.status = row.at("status").get<std::string>();
  score.row.value =
      row.at("value").is_null() ? std::numeric_limits<double>::quiet_NaN() : row.at("value").get<double>();
  score.tolerance = row.at("tolerance").get<double>();
  score.first = score.row.value;
  if (row.contains("first") && !row.at("first").is_null()) score.first = row.at("first").get<double>();
  score.known_drift = row.value("known_drift", 0.0);
  return score;
}

std::vector<StepBytes> steps_from(const json& text) {
  std::vector<StepBytes> steps;
  if (!text.contains("steps")) return steps;
  for (const auto& step : text.at("steps"))
    steps.push_back({step.at("step").get<std::string>(), step.at("content").get<std::string>(),
                     step.at("inputs").get<std::string>()});
  return steps;
}

GoldenCase recipe_from(const json& text, const std::string& name) {
  GoldenCase result;
  result.name = name;
  result.scene = text.at("scene");
  result.scale = text.at("scale");
  result.seed = text.at("seed");
  result.known_misses = text.value("known_misses", std::map<std::string, std::string>());
  result.history = text.value("history", std::vector<std::string>());
  result.image_drift = text.value("image_drift", std::map<std::string, double>());
  result.environment = text.value("environment", Environment());
  result.steps = steps_from(text);
  return result;
}

json to_json(const std::vector<StepBytes>& steps) {
  json result = json::array();
  for (const auto& step : steps)
    result.push_back({{"step", step.step}, {"content", step.content}, {"inputs", step.inputs}});
  return result;
}

json to_json(const GoldenScore& score) {
  const auto number = [](double value) { return std::isfinite(value) ? json(value) : json(); };
  json result = {{"stage", score.row.stage},         {"metric", score.row.metric}, {"unit", score.row.unit},
                 {"value", number(score.row.value)}, {"status", score.row.status}, {"tolerance", score.tolerance}};
  if (std::isfinite(score.first) && score.first != score.row.value) result["first"] = score.first;
  if (score.known_drift > 0) result["known_drift"] = score.known_drift;
  return result;
}

cv::Mat image_from(const fs::path& file, const std::string& hash) {
  const cv::Mat image = cv::imread(file.string(), cv::IMREAD_COLOR);
  if (image.empty()) throw GoldenError(file.string() + ": missing or no image; expected an accepted one");
  if (pixel_hash(image) != hash) throw GoldenError(file.string() + ": corrupt; its pixels are not the accepted ones");
  return image;
}

// Runs `read` and turns a JSON complaint into a GoldenError that names the file.
template <class Read>
auto reading(const fs::path& golden, const std::string& name, const Read& read) {
  try {
    return read(read_golden_json(golden, name));
  } catch (const json::exception& error) {
    throw GoldenError((golden / name / "golden.json").string() + ": corrupt (" + error.what() + ")");
  }
}

}  // namespace

std::string pixel_hash(const cv::Mat& image) {
  const cv::Mat whole = image.isContinuous() ? image : image.clone();
  return hash_hex({reinterpret_cast<const char*>(whole.data), whole.total() * whole.elemSize()});
}

GoldenCase read_golden_recipe(const fs::path& golden, const std::string& name) {
  return reading(golden, name, [&](const json& text) { return recipe_from(text, name); });
}

GoldenCase read_golden_case(const fs::path& golden, const std::string& name) {
  return reading(golden, name, [&](const json& text) {
    GoldenCase result = recipe_from(text, name);
    for (const auto& row : text.at("scores")) result.scores.push_back(score_from(row));
    for (const auto& [metric, reason] : result.known_misses)
      if (reason.empty())
        throw GoldenError((golden / name / "golden.json").string() + ": known_misses." + metric +
                          ": no reason; expected why the target is missed");
    if (result.scores.empty())
      throw GoldenError((golden / name / "golden.json").string() + ": empty; expected accepted scores");
    if (text.at("images").empty())
      throw GoldenError((golden / name / "golden.json").string() + ": empty; expected accepted images");
    for (const auto& [stem, hash] : text.at("images").items())
      result.images[stem] = image_from(golden / name / (stem + ".png"), hash);
    return result;
  });
}

void write_golden_case(const fs::path& golden, const GoldenCase& golden_case) {
  fs::create_directories(golden / golden_case.name);
  json scores = json::array(), images = json::object();
  for (const auto& score : golden_case.scores) scores.push_back(to_json(score));
  for (const auto& [stem, image] : golden_case.images) {
    std::vector<unsigned char> bytes;
    cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9});
    write_file_atomically(golden / golden_case.name / (stem + ".png"), std::string(bytes.begin(), bytes.end()));
    images[stem] = pixel_hash(image);
  }
  const json text = {{"format", "dressform-golden"},
                     {"version", 1},
                     {"scene", golden_case.scene},
                     {"scale", golden_case.scale},
                     {"seed", golden_case.seed},
                     {"history", golden_case.history},
                     {"known_misses", golden_case.known_misses},
                     {"scores", scores},
                     {"images", images},
                     {"image_drift", golden_case.image_drift},
                     {"environment", golden_case.environment},
                     {"steps", to_json(golden_case.steps)}};
  write_file_atomically(golden / golden_case.name / "golden.json", text.dump(1) + "\n");
}

std::vector<std::string> golden_case_names(const fs::path& golden) {
  std::vector<std::string> names;
  if (fs::is_directory(golden))
    for (const auto& entry : fs::directory_iterator(golden))
      if (entry.is_directory()) names.push_back(entry.path().filename().string());
  if (names.empty()) throw GoldenError(golden.string() + ": no case; expected folders with a golden.json");
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace dressform
