// observed.json and the images beside it: what a run showed the gate, for the accept that follows and for other
// programs that measure nuisance.
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "eval/gate/golden_run.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kObservedFormat = "dressform-gate-run";

}  // namespace

void write_golden_run(const fs::path& folder, const GoldenRun& run) {
  fs::create_directories(folder);
  json steps = json::array(), images = json::object();
  for (const auto& step : run.steps)
    steps.push_back({{"step", step.step}, {"content", step.content}, {"inputs", step.inputs}});
  for (const auto& [stem, image] : run.images) {
    std::vector<unsigned char> bytes;
    cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 3});
    write_file_atomically(folder / (stem + ".png"), std::string(bytes.begin(), bytes.end()));
    images[stem] = pixel_hash(image);
  }
  write_file_atomically(folder / "scores.json", scores_to_json(run.scores));
  const json text = {{"format", kObservedFormat},
                     {"version", 1},
                     {"environment", run.environment},
                     {"steps", steps},
                     {"images", images},
                     {"identity", run.identity()}};
  write_file_atomically(folder / "observed.json", text.dump(1) + "\n");  // last: who finds it finds the others
}

GoldenRun read_golden_run(const fs::path& folder) {
  const fs::path file = folder / "observed.json";
  const auto wrong = [&](const std::string& problem) {
    return InputError(file.string(), problem + "; expected what `dressform gate check` wrote there");
  };
  const json text = json::parse(read_file_bytes(file), nullptr, false);
  if (!text.is_object() || text.value("format", json()) != json(kObservedFormat) ||
      text.value("version", json()) != json(1))
    throw wrong("is no gate run of version 1");
  try {
    GoldenRun run;
    run.environment = text.at("environment").get<Environment>();
    for (const auto& step : text.at("steps"))
      run.steps.push_back({step.at("step").get<std::string>(), step.at("content").get<std::string>(),
                           step.at("inputs").get<std::string>()});
    run.scores = scores_from_json(folder / "scores.json");
    for (const auto& [stem, hash] : text.at("images").items()) {
      const cv::Mat image = cv::imread((folder / (stem + ".png")).string(), cv::IMREAD_COLOR);
      if (image.empty() || json(pixel_hash(image)) != hash)
        throw wrong("its image " + stem + ".png is missing or damaged");
      run.images[stem] = image;
    }
    if (json(run.identity()) != text.at("identity")) throw wrong("its scores are not those of the run");
    return run;
  } catch (const json::exception& error) {
    throw wrong(std::string("damaged (") + error.what() + ")");
  }
}

}  // namespace dressform
