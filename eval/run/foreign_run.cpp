#include "eval/run/foreign_run.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

#include "eval/score/evaluate.h"
#include "eval/score/metric.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/json_file.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestValue = 1e12;    // no score is that large
constexpr int kMostSamples = 2000000000;  // of one row
constexpr std::size_t kMostPictureBytes = std::size_t{1} << 28;

double value_of(const JsonValue& row, const std::string& status) {
  if (status != "ok") return std::nan("");
  return row.at("value").number(-kLargestValue, kLargestValue);
}

ScoreRow foreign_row(const JsonValue& row) {
  ScoreRow score;
  score.stage = row.at("stage").text();
  score.metric = row.at("metric").text();
  score.unit = row.at("unit").text();
  score.status = row.has("status") ? row.at("status").text() : "ok";
  if (score.status != "ok" && score.status != "failed" && score.status != "absent")
    row.at("status").fail("found \"" + score.status + "\"; expected ok, failed or absent");
  score.value = value_of(row, score.status);
  score.n_samples = row.has("n_samples") ? row.at("n_samples").whole(0, kMostSamples) : 0;
  const Metric* metric = find_metric(score.stage, score.metric);
  if (metric && metric->unit != score.unit)
    row.at("unit").fail("found \"" + score.unit + "\" of " + score.stage + " " + score.metric + "; expected \"" +
                        metric->unit + "\", as `dressform metrics` lists it");
  return score;
}

Scores foreign_scores(const fs::path& file) {
  const JsonValue text = read_json(file, "dressform-scores", 1);
  Scores scores;
  std::set<std::pair<std::string, std::string>> known;
  for (const auto& row : text.at("scores").elements()) {
    scores.rows.push_back(foreign_row(row));
    const ScoreRow& score = scores.rows.back();
    if (!known.insert({score.stage, score.metric}).second)
      row.at("metric").fail("found \"" + score.metric + "\" of " + score.stage + " twice; expected it once");
  }
  return scores;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// Signature, and the size that its header names: what a picture is looked at for is somebody else's business.
void check_picture(const fs::path& file) {
  static const std::string kStart("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  const std::string bytes = read_file_bytes(file, kMostPictureBytes);
  if (bytes.size() < 24 || bytes.compare(0, kStart.size(), kStart) != 0)
    throw InputError(file.string(), "is no PNG; expected one");
  const std::uint32_t width = big_endian(bytes, 16), height = big_endian(bytes, 20);
  if (width < 1 || height < 1 || width > kLargestPicture || height > kLargestPicture)
    throw InputError(file.string(), "found " + std::to_string(width) + " x " + std::to_string(height) +
                                        " pixels; expected 1 to " + std::to_string(kLargestPicture) + " a side");
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> pictures;
  if (!fs::is_directory(folder)) return pictures;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png") pictures.push_back(entry.path());
  std::sort(pictures.begin(), pictures.end());
  for (const auto& picture : pictures) check_picture(picture);
  return pictures;
}

}  // namespace

ForeignRun read_foreign_run(const fs::path& run_folder, const fs::path& session) {
  const fs::path out = run_folder / "out";
  const bool meshes = fs::exists(out / "registration.json"), scores = fs::exists(out / "scores.json");
  if (meshes == scores)
    throw InputError(out.string(), std::string(meshes ? "holds both registration.json and scores.json"
                                                      : "holds neither registration.json nor scores.json") +
                                       "; expected one of the two: poses and meshes to be scored, or scores");
  ForeignRun run;
  run.pictures = pictures_in(out / "pictures");
  if (scores) {
    run.scores = foreign_scores(out / "scores.json");
    return run;
  }
  const RunOutputs outputs = read_foreign_outputs(run_folder);
  if (session.empty() || !ground_truth_exists(session)) return run;
  run.scores = evaluate(outputs, read_ground_truth(session));
  run.scored_here = true;
  return run;
}

}  // namespace dressform
