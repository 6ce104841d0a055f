#include "eval/report/report.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <opencv2/imgcodecs.hpp>

#include "eval/report/error_images.h"
#include "eval/report/html.h"
#include "eval/report/score_table.h"
#include "eval/report/stage_images.h"
#include "eval/report/stage_words.h"
#include "pipeline/run/artifact_store.h"
#include "render/renderer.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using Cell = HtmlPage::Cell;

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

void add_scores(HtmlPage& page, const ReportInput& input) {
  page.heading("Scores", "scores");
  if (!input.scores) {
    page.paragraph("The session has no ground truth: there is nothing to score against.");
    return;
  }
  const auto lines = score_lines(*input.scores);
  const std::optional<double> scale =
      input.facts.contains("scale") ? input.facts["scale"].get<double>() : std::optional<double>();
  const TargetCount count = count_targets(lines, scale);
  std::string verdict = count.missed ? fmt::format("{} of {} targets missed", count.missed, count.judged)
                                     : fmt::format("All {} targets met", count.judged);
  if (count.missed_below_scale)
    verdict += fmt::format(", {} of them meant to hold at a larger scale than {:g}", count.missed_below_scale, *scale);
  page.verdict(verdict, count.missed == 0);
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

std::vector<std::string> write_images(const std::vector<const Figure*>& figures, const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto* figure : figures) files.push_back("renders/" + figure->name + ".png");
  fs::create_directories(folder / "renders");
  tbb::parallel_for(std::size_t{0}, figures.size(), [&](std::size_t i) {
    std::vector<unsigned char> bytes;
    cv::imencode(".png", figures[i]->image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 3});
    write_file_atomically(folder / files[i], std::string(bytes.begin(), bytes.end()));
  });
  return files;
}

}  // namespace

std::vector<std::string> write_report(const ReportInput& input, const fs::path& folder) {
  Renderer renderer;
  const auto results = result_figures(input.reconstruction, renderer);
  const auto errors = input.truth ? error_figures(input.reconstruction, *input.truth, renderer) : std::vector<Figure>();
  const auto stages = stage_figures(input.reconstruction, input.session, renderer);

  HtmlPage page("dressform: " + input.facts.value("scene", std::string("run")));
  page.paragraph(fmt::format("Seed {}, variants: {}.", input.facts.value("seed", Seed{0}),
                             input.facts.value("variant", std::string("default"))));
  add_problems(page, input);
  page.heading("Result", "result");
  for (const auto& figure : results) page.figure(figure);
  add_scores(page, input);
  if (!errors.empty()) page.heading("Against the truth", "truth");
  for (const auto& figure : errors) page.figure(figure);
  add_stages(page, input, stages);
  add_costs(page, input);
  add_all_scores(page, input);
  page.heading("Provenance", "provenance");
  page.preformatted("run.json", input.facts.dump(1));

  std::vector<const Figure*> figures;
  for (const auto& figure : results) figures.push_back(&figure);
  for (const auto& figure : errors) figures.push_back(&figure);
  for (const auto& stage : stages)
    for (const auto& figure : stage.figures) figures.push_back(&figure);
  auto files = write_images(figures, folder);
  write_file_atomically(folder / "report.html", page.text());
  files.push_back("report.html");
  return files;
}

std::vector<std::string> write_result_images(const Reconstruction& reconstruction, const fs::path& folder) {
  Renderer renderer;
  const auto results = result_figures(reconstruction, renderer, false);
  std::vector<const Figure*> figures;
  for (const auto& figure : results) figures.push_back(&figure);
  return write_images(figures, folder);
}

}  // namespace dressform
