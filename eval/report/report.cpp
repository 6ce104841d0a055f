#include "eval/report/report.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "eval/report/error_images.h"
#include "eval/report/html.h"
#include "eval/report/joined_garments.h"
#include "eval/report/score_table.h"
#include "eval/report/stage_images.h"
#include "eval/report/stage_words.h"
#include "pipeline/run/artifact_store.h"
#include "render/renderer.h"
#include "scenes/file_bytes.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using Cell = HtmlPage::Cell;

constexpr int kModelTexturePx = 768;                // of a garment in a page: sharp at the size it is shown there
constexpr std::size_t kMostModelBytes = 4'000'000;  // of a model in a page: two and all pictures stay within 15 MB

const std::map<std::string, std::string> kStageTitles = {{"capture", "Capture"},
                                                         {"fuse_naked", "Scan of the mannequin"},
                                                         {"extract", "Mannequin from the room"},
                                                         {"registration", "Registration"},
                                                         {"landmarks_naked", "Landmarks"},
                                                         {"segment", "Segmentation"},
                                                         {"fill", "Region filling"},
                                                         {"surface", "Surface"},
                                                         {"open", "Openings"},
                                                         {"texture", "Texture"},
                                                         {"fuse_user", "Scan of the user"},
                                                         {"fit", "Fit"},
                                                         {"correct", "Correction"}};

// The first line: whether it is good enough.
void add_verdict(HtmlPage& page, const ReportInput& input, const std::vector<ScoreLine>& lines) {
  if (!input.scores)
    return page.paragraph("The session has no ground truth: there is nothing to score against, only what was made.");
  const std::optional<double> scale =
      input.facts.contains("scale") ? input.facts["scale"].get<double>() : std::optional<double>();
  const TargetCount count = count_targets(lines, scale);
  std::string verdict = count.missed ? fmt::format("{} of {} targets missed", count.missed, count.judged)
                                     : fmt::format("All {} targets met", count.judged);
  if (count.missed_below_scale)
    verdict += fmt::format(", {} of them meant to hold at a larger scale than {:g}", count.missed_below_scale, *scale);
  page.verdict(verdict, count.missed == 0);
}

// Missed targets first, then those that were met, then what has no target; each in the order of the pipeline.
void add_scores(HtmlPage& page, std::vector<ScoreLine> lines) {
  if (lines.empty()) return;
  page.heading("Scores, worst first", "scores");
  const auto rank = [](const ScoreLine& line) { return line.missed() ? 0 : line.judged() ? 1 : 2; };
  std::stable_sort(lines.begin(), lines.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  std::vector<std::vector<Cell>> rows;
  for (const auto& line : lines)
    rows.push_back({{line.part, ""},
                    {line.measure, ""},
                    {line.value, line.missed()   ? "bad"
                                 : line.judged() ? "good"
                                                 : ""},
                    {line.target, "quiet"}});
  page.table({"Part", "Measure", "Value", "Target"}, rows);
}

void add_all_scores(HtmlPage& page, const ReportInput& input) {
  if (!input.scores) return;
  page.heading("Every measure", "measures");
  std::vector<std::vector<Cell>> rows;
  for (const auto& row : input.scores->rows)
    rows.push_back({{row.stage, ""},
                    {row.metric, ""},
                    {row.status == "ok" ? fmt::format("{:.4g}", row.value) : "-", ""},
                    {row.unit, "quiet"},
                    {row.status, row.status == "failed" ? "bad" : "quiet"},
                    {std::to_string(row.n_samples), "quiet"}});
  page.table({"Stage", "Metric", "Value", "Unit", "Status", "Samples"}, rows);
}

void add_costs(HtmlPage& page, const ReportInput& input) {
  page.heading("Cost", "cost");
  std::vector<std::vector<Cell>> rows;
  double total = 0;
  for (const auto& record : input.reconstruction.records) {
    total += record.seconds;
    rows.push_back({{record.label, ""},
                    {record.recipe.variant, ""},
                    {fmt::format("{:.1f}", record.seconds), ""},
                    {fmt::format("{:.0f}", record.peak_memory_mb), ""}});
  }
  rows.push_back({{"together", ""}, {"", ""}, {fmt::format("{:.1f}", total), ""}, {"", ""}});
  page.table({"Stage", "Variant", "Seconds", "Peak memory, MB"}, rows);
  page.paragraph("Seconds of the run that made each result; a result found in the store cost nothing now.");
}

// The first lines: which stages failed and why.
void add_problems(HtmlPage& page, const ReportInput& input) {
  for (const auto& problem : input.problems)
    page.verdict((problem.garment_missing ? "Garment missing. " : "Failed. ") + problem.text(), false);
}

void add_stages(HtmlPage& page, const ReportInput& input, const std::vector<StageFigures>& stages) {
  page.heading("Stage by stage", "stages");
  for (const auto& stage : stages) {
    const auto title = kStageTitles.find(stage.label);
    page.subheading(title == kStageTitles.end() ? stage.label : title->second);
    if (const std::string text = stage_words(input.reconstruction, stage.label); !text.empty()) page.paragraph(text);
    for (const auto& figure : stage.figures) page.figure(figure);
  }
}

// Garments to be turned: renders/<name>.glb, and inside the page where it is small enough.
void add_model(HtmlPage& page, const std::string& name, const std::string& title,
               const std::map<std::string, TexturedMesh>& garments, const fs::path& folder,
               std::vector<std::string>& files) {
  const TexturedMesh joined = joined_garments(garments, kModelTexturePx);
  if (joined.mesh.triangles.empty()) return;
  files.push_back("renders/" + name + ".glb");
  write_glb(folder / files.back(), joined);
  const std::string bytes = read_file_bytes(folder / files.back());
  if (bytes.size() <= kMostModelBytes) return page.model(title, bytes);
  page.paragraph(fmt::format("{}: {} has {:.1f} MB, too much for a page; any viewer of GLB shows it.", title,
                             files.back(), 1e-6 * static_cast<double>(bytes.size())));
}

void add_models(HtmlPage& page, const ReportInput& input, const fs::path& folder, std::vector<std::string>& files) {
  add_model(page, "model_mannequin", "the clothes as reconstructed", input.reconstruction.textured.get().garments,
            folder, files);
  if (input.reconstruction.corrected)
    add_model(page, "model_user", "the clothes as fitted to the user", input.reconstruction.corrected->get().garments,
              folder, files);
}

struct ImageFile {
  std::string name;
  const cv::Mat* image;
};

std::vector<std::string> write_images(const std::vector<ImageFile>& images, const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& image : images) files.push_back("renders/" + image.name + ".png");
  tbb::parallel_for(std::size_t{0}, images.size(), [&](std::size_t i) {
    std::vector<unsigned char> bytes;
    cv::imencode(".png", *images[i].image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 3});
    write_file_atomically(folder / files[i], std::string(bytes.begin(), bytes.end()));
  });
  return files;
}

std::vector<ImageFile> image_files(const std::vector<Figure>& results, const ErrorImages& errors,
                                   const std::vector<StageFigures>& stages) {
  std::vector<ImageFile> images;
  for (const auto& figure : results) images.push_back({figure.name, &figure.image});
  for (const auto& figure : errors.maps) images.push_back({figure.name, &figure.image});
  for (const auto& each : errors.beside_truth) {
    images.push_back({each.name + "_new", &each.made});
    images.push_back({each.name + "_reference", &each.reference});
    images.push_back({each.name + "_difference", &each.difference});
  }
  for (const auto& stage : stages)
    for (const auto& figure : stage.figures) images.push_back({figure.name, &figure.image});
  return images;
}

}  // namespace

std::vector<std::string> write_report(const ReportInput& input, const fs::path& folder) {
  Renderer renderer;
  const auto results = result_figures(input.reconstruction, renderer);
  const auto errors = input.truth ? error_images(input.reconstruction, *input.truth, renderer) : ErrorImages();
  const auto stages = stage_figures(input.reconstruction, input.session, renderer);
  const auto lines = input.scores ? score_lines(*input.scores) : std::vector<ScoreLine>();
  fs::create_directories(folder / "renders");
  auto files = write_images(image_files(results, errors, stages), folder);

  HtmlPage page("dressform: " + input.facts.value("scene", std::string("run")));
  add_problems(page, input);
  add_verdict(page, input, lines);
  page.paragraph(fmt::format("Seed {}, variants: {}.", input.facts.value("seed", Seed{0}),
                             input.facts.value("variant", std::string("default"))));
  page.heading("Result", "result");
  for (const auto& figure : results) page.figure(figure);
  add_models(page, input, folder, files);
  add_scores(page, lines);
  if (!errors.maps.empty()) page.heading("Against the truth", "truth");
  for (const auto& figure : errors.maps) page.figure(figure);
  for (const auto& comparison : errors.beside_truth) page.comparison(comparison);
  add_stages(page, input, stages);
  add_costs(page, input);
  add_all_scores(page, input);
  page.heading("Provenance", "provenance");
  page.preformatted("run.json", input.facts.dump(1));

  write_file_atomically(folder / "report.html", page.text());
  files.push_back("report.html");
  return files;
}

std::vector<std::string> write_result_images(const Reconstruction& reconstruction, const fs::path& folder) {
  Renderer renderer;
  const auto results = result_figures(reconstruction, renderer, false);
  fs::create_directories(folder / "renders");
  return write_images(image_files(results, {}, {}), folder);
}

}  // namespace dressform
