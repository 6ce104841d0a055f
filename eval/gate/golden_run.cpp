#include "eval/gate/golden_run.h"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/run/capture_store.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kImageHeight = 220;

cv::Mat small_image(const fs::path& file) {
  const cv::Mat image = cv::imread(file.string(), cv::IMREAD_COLOR);
  if (image.empty()) throw std::runtime_error(file.string() + ": the run made no such image");
  cv::Mat result;
  cv::resize(image, result, {image.cols * kImageHeight / image.rows, kImageHeight}, 0, 0, cv::INTER_AREA);
  return result;
}

// Names what this environment makes: a store's keys know the code, but not what compiled it.
std::string environment_hash() {
  constexpr std::size_t kDigits = 8;
  std::string text;
  for (const auto& [name, value] : this_environment()) text += name + "=" + value + "\n";
  return hash_hex(text).substr(0, kDigits);
}

// Takes away what another environment made in a case's folder, or a run that showed nothing: its scores and images must
// not pass for this one's.
void remove_foreign_run(const fs::path& run, const fs::path& observed) {
  std::error_code ignored;
  try {
    if (fs::exists(run / "run.json") && read_golden_run(observed).environment == this_environment()) return;
  } catch (const InputError&) {  // no or a damaged observation
  }
  if (fs::exists(run / "run.json")) fs::remove_all(run, ignored);
}

// What a stage was asked and given: the recipe without its code's version.
std::string inputs_of(const Recipe& recipe) {
  Recipe without_code = recipe;
  without_code.code_version.clear();
  return without_code.key();
}

// The bytes of all steps, from the records and from what the run's folder says about itself.
std::vector<StepBytes> steps_of(const EndToEndResult& result, const SceneRunRequest& request, const GoldenRun& seen) {
  const json facts = json::parse(read_file_bytes(request.output / "run.json"));
  const std::string asked =
      hash_hex(scene_hash(request.scene) + to_text(FieldValue(request.scale)) + std::to_string(request.options.seed));
  const std::string truth = facts.at("session").at("truth_hash");
  std::vector<StepBytes> steps{{"capture", facts.at("session").at("content_hash"), asked}, {"truth", truth, asked}};
  std::string made;
  for (const auto& record : result.records) {
    steps.push_back({record.label, record.content_hash, inputs_of(record.recipe)});
    made += record.content_hash + " ";
  }
  const std::string out = hash_hex(facts.at("products").at("out").at("files").dump());
  steps.push_back({"out", out, hash_hex(made)});
  steps.push_back({"scores", hash_hex(scores_to_json(seen.scores)), hash_hex(made + out + truth)});
  for (const auto& [stem, image] : seen.images) steps.push_back({"image " + stem, pixel_hash(image), hash_hex(made)});
  return steps;
}

}  // namespace

std::string GoldenRun::identity() const {
  std::string text = scores_to_json(scores);
  for (const auto& [stem, image] : images) text += stem + " " + pixel_hash(image) + "\n";
  for (const auto& step : steps) text += step.step + " " + step.content + "\n";
  return hash_hex(text);
}

fs::path observed_folder(const fs::path& work, const std::string& name) { return work / name / "gate"; }

SceneRunRequest scene_request(const GoldenCase& golden_case, const GoldenRunRequest& asked) {
  const auto root = fs::absolute(asked.golden).lexically_normal().parent_path();
  SceneRunRequest request{scaled(read_scene(root / golden_case.scene), golden_case.scale),
                          golden_case.scale,
                          asked.work / golden_case.name,
                          asked.work / (".dressform-store-" + environment_hash()),
                          "default",
                          {},
                          asked.threads};
  request.options.seed = golden_case.seed;
  request.report = asked.report;
  request.result_images = true;
  return request;
}

GoldenRun golden_run_of(const EndToEndResult& result, const SceneRunRequest& request) {
  GoldenRun run{result.scores.value(), {}, {}, this_environment()};
  for (const char* name : {"result_mannequin", "result_user"})
    run.images[name] = small_image(request.output / "renders" / (std::string(name) + ".png"));
  run.steps = steps_of(result, request, run);
  return run;
}

GoldenRun run_golden_case(const GoldenCase& golden_case, const GoldenRunRequest& asked,
                          const SceneRunProgress& progress) {
  const SceneRunRequest request = scene_request(golden_case, asked);
  remove_foreign_run(request.output, observed_folder(asked.work, golden_case.name));
  const GoldenRun run = golden_run_of(run_scene(request, progress), request);
  write_golden_run(observed_folder(asked.work, golden_case.name), run);
  return run;
}

}  // namespace dressform
