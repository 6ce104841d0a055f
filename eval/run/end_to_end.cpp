#include "eval/run/end_to_end.h"

#include <fmt/format.h>

#include <chrono>
#include <opencv2/imgcodecs.hpp>

#include "eval/oracle/oracle.h"
#include "eval/report/report.h"
#include "eval/run/export.h"
#include "eval/run/run_folder.h"
#include "eval/run/stage_folders.h"
#include "eval/run/truth_hash.h"
#include "eval/score/evaluate.h"
#include "scenes/file_bytes.h"
#include "scenes/ground_truth.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json to_json(const StageRecord& record) {
  json values = json::object();
  for (const auto& [name, value] : record.recipe.values)
    std::visit([&, &name = name](const auto& held) { values[name] = held; }, value);
  return {{"stage", record.label},
          {"variant", record.recipe.variant},
          {"parameters", values},
          {"key", record.key},
          {"seconds", record.seconds},
          {"peak_memory_mb", record.peak_memory_mb},
          {"reused", record.reused},
          {"code_version", record.recipe.code_version},
          {"content_hash", record.content_hash}};
}

json to_json(const ReconstructionOptions& options) {
  json values = json::object();
  for (const auto& [stage, given] : options.values)
    for (const auto& [name, value] : given) values[stage][name] = to_text(value);
  return {{"variants", options.variants}, {"values", values}};
}

// Hash over everything the pipeline made: the contents of the artifacts, whatever made them.
std::string identity_of(const Reconstruction& made) {
  std::string text = made.calibration.content_hash() + made.naked.content_hash() + made.extracted.content_hash() +
                     made.registration.content_hash() + made.segmentation.content_hash() + made.filled.content_hash() +
                     made.closed.content_hash() + made.opened.content_hash() + made.textured.content_hash();
  if (made.user) text += made.user->content_hash();
  if (made.fitted) text += made.fitted->content_hash();
  if (made.corrected) text += made.corrected->content_hash();
  return hash_hex(text + code_version("eval"));
}

std::vector<std::string> with_prefix(const std::string& prefix, std::vector<std::string> names) {
  for (auto& name : names) name = prefix + name;
  return names;
}

// The label images, for the scorer and for people: stages/<nn>_segment/<sensor>.png.
std::vector<std::string> write_labels(const Reconstruction& made, const std::string& folder, const fs::path& run) {
  std::vector<std::string> files;
  for (const auto& [sensor, labels] : made.segmentation.get().labels) {
    const std::string name = folder + "/" + sensor + ".png";
    std::vector<unsigned char> bytes;
    cv::imencode(".png", labels, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
    write_file_atomically(run / name, std::string(bytes.begin(), bytes.end()));
    files.push_back(name);
  }
  return files;
}

std::string segment_folder(const Reconstruction& made) {
  for (const auto& record : made.records)
    if (record.recipe.stage == "segment") return "stages/" + stage_folder_name(record);
  throw std::logic_error("the pipeline has no segment stage");
}

// Runs one product of the folder with progress.
class Steps {
 public:
  Steps(RunFolder& folder, const EndToEndProgress& progress) : folder_(folder), progress_(progress) {}
  void run(const std::string& name, const std::string& identity,
           const std::function<std::vector<std::string>()>& make) {
    if (progress_.step) progress_.step(name);
    const auto start = std::chrono::steady_clock::now();
    const bool made = folder_.product(name, identity, make);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (progress_.step_finished) progress_.step_finished(name, made, seconds.count());
  }

 private:
  RunFolder& folder_;
  const EndToEndProgress& progress_;
};

std::vector<std::string> write_scores(const EndToEndRequest& request, const GroundTruth& truth) {
  Scores scores = evaluate(read_run_outputs(request.output), truth);
  scores.scene = request.scene;
  scores.variant = request.variant;
  scores.seed = request.options.seed;
  write_file_atomically(request.output / "scores.json", scores_to_json(scores));
  write_file_atomically(request.output / "scores.csv",
                        scores_to_csv(scores, fmt::format("{}-{}", request.scene, request.options.seed)));
  return {"scores.json", "scores.csv"};
}

// problems.json, so that a second run need not bring all results into memory to tell.
std::vector<StageProblem> known_problems(const Reconstruction& made, const std::string& identity,
                                         const EndToEndRequest& request, Steps& steps) {
  const fs::path file = request.output / "problems.json";
  steps.run("problems", identity, [&] {
    const auto found = with_unfound_garments(stage_problems(made), made, truth_garment_names(request.session));
    write_file_atomically(file, to_json(found).dump(1) + "\n");
    return std::vector<std::string>{"problems.json"};
  });
  return problems_from_json(json::parse(read_file_bytes(file)));  // intact, or just written
}

// What was asked, for run.json.
json facts_of(const EndToEndRequest& request, const SessionSource& source, const std::string& truth) {
  json facts = request.facts;
  facts["provenance"] = provenance(request.threads);
  facts["scene"] = request.scene;
  facts["variant"] = request.variant;
  facts["seed"] = request.options.seed;
  facts["store"] = fs::absolute(request.store).lexically_normal().string();
  facts["options"] = to_json(request.options);
  if (!request.oracles.empty()) facts["oracles"] = request.oracles;
  facts["session"] = {{"path", fs::absolute(request.session).string()},
                      {"content_hash", source.session.content_hash()},
                      {"truth_hash", truth}};
  return facts;
}

}  // namespace

EndToEndResult run_end_to_end(const EndToEndRequest& request, const EndToEndProgress& progress) {
  check_options(request.options);
  const SessionSource source = open_session(request.session, request.check_session);
  RunFolder folder(request.output);
  const std::string hash_of_truth = truth_hash(request.session);  // read once: truth is as large as the session
  folder.facts() = facts_of(request, source, hash_of_truth);
  ArtifactStore store(request.store);
  std::optional<GroundTruth> truth;
  const auto known_truth = [&]() -> const GroundTruth& {
    if (!truth) truth = read_ground_truth(request.session);
    return *truth;
  };
  const Reconstruction made =
      request.oracles.empty()
          ? reconstruct(source, request.options, store, progress.stage)
          : reconstruct_with_truth(source, request.options, store, progress.stage, request.oracles, known_truth());
  folder.facts()["stages"] = json::array();
  for (const auto& record : made.records) folder.facts()["stages"].push_back(to_json(record));
  write_stage_folders(request.output / "stages", made.records, store);

  Steps steps(folder, progress);
  const std::string identity = identity_of(made);
  EndToEndResult result;
  result.problems = known_problems(made, hash_hex(identity + hash_of_truth), request, steps);
  folder.facts()["problems"] = to_json(result.problems);
  steps.run("out", identity, [&] { return with_prefix("out/", export_reconstruction(made, request.output / "out")); });
  steps.run("labels", made.segmentation.content_hash(),
            [&] { return write_labels(made, segment_folder(made), request.output); });

  std::string scores_hash = "none";
  if (ground_truth_exists(request.session)) {
    const std::string scored =
        hash_hex(folder.product_hash("out") + folder.product_hash("labels") + hash_of_truth + request.scene +
                 request.variant + std::to_string(request.options.seed) + code_version("eval"));
    steps.run("scores", scored, [&] { return write_scores(request, known_truth()); });
    result.scores = scores_from_json(request.output / "scores.json");
    scores_hash = folder.product_hash("scores");
  }
  if (request.report) {
    const std::string report_identity =
        hash_hex(identity + scores_hash + source.session.content_hash() + code_version("render"));
    steps.run("report", report_identity, [&] {
      const ReportInput input{made,           source.session.get(),
                              result.scores,  result.scores ? &known_truth() : nullptr,
                              folder.facts(), result.problems};
      return write_report(input, request.output);
    });
    result.report = request.output / "report.html";
  } else if (request.result_images) {
    steps.run("result_images", hash_hex(identity + code_version("render")),
              [&] { return write_result_images(made, request.output); });
  }
  folder.save();
  if (request.facts.contains("scale")) result.scale = request.facts["scale"].get<double>();
  result.records = made.records;
  return result;
}

}  // namespace dressform
