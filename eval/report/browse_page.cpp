#include "eval/report/browse_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/report/html_assets.h"
#include "eval/score/metric.h"
#include "eval/studies/results_index.h"
#include "render/charts/markup.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr int kThumbnailPx = 56;  // high: a garment can be told at a glance

constexpr const char* kBrowseStyle = R"(
body { max-width: none; } td img { display: block; border: 0; } th button { display: block; margin-top: 2px; }
th svg { display: block; } #filter { font: inherit; padding: 4px 8px; width: 100%; max-width: 420px; }
)";

constexpr const char* kBrowseScript = R"(
'use strict';
const body = document.querySelector('tbody'), rows = [...body.rows];
document.querySelectorAll('thead th').forEach((head, column) => {
  const press = document.createElement('button');
  press.type = 'button'; press.textContent = 'Sort';
  press.setAttribute('aria-label', 'Sort by ' + head.dataset.name);
  let up = false;
  press.addEventListener('click', () => {
    up = !up;
    const key = row => row.cells[column].dataset.value ?? row.cells[column].textContent;
    const number = text => text === '' || isNaN(text) ? null : Number(text);
    const order = (a, b) => {
      const x = key(a), y = key(b), m = number(x), n = number(y);
      if ((x === '') !== (y === '')) return x === '' ? 1 : -1;  // what is not there comes last either way
      return (up ? 1 : -1) * (m !== null && n !== null ? m - n : x.localeCompare(y));
    };
    for (const other of document.querySelectorAll('thead th')) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
    body.append(...rows.sort(order));
  });
  head.append(press);
});
const label = document.createElement('label'), field = document.createElement('input');
label.textContent = 'Only runs with all these words: '; field.id = 'filter'; field.type = 'search';
label.append(field); document.querySelector('main').prepend(label);
field.addEventListener('input', () => {
  const words = field.value.toLowerCase().split(/\s+/);
  for (const row of rows) {
    const text = row.textContent.toLowerCase();
    row.hidden = !words.every(word => text.includes(word));
  }
});
)";

std::string head_cell(const std::string& name, const std::string& spark) {
  return fmt::format("<th scope=\"col\" data-name=\"{0}\">{0}{1}</th>", html_escaped(name), spark);
}

std::string value_cell(const BrowsedColumn& column, const std::string& value, const std::string& status) {
  if (value.empty()) return fmt::format("<td class=\"quiet\" data-value=\"\">{}</td>", html_escaped(status));
  const Metric* metric = find_metric(column.stage, column.metric);
  const double number = std::atof(value.c_str());
  const char* mark = !metric || !metric->target ? "" : metric->meets_target(number) ? "good" : "bad";
  return fmt::format("<td class=\"{}\" data-value=\"{}\">{}</td>", mark, html_escaped(value),
                     html_escaped(number_text(number, metric ? metric->unit : "1")));
}

std::string run_row(const std::vector<BrowsedColumn>& columns, const BrowsedRun& run) {
  std::string row = "<tr><td data-value=\"\">";
  if (!run.thumbnail.empty())
    row += fmt::format("<img alt=\"result of {}\" height=\"{}\" loading=\"lazy\" src=\"data:image/jpeg;base64,{}\">",
                       html_escaped(run.folder), kThumbnailPx, base64(run.thumbnail));
  const std::string name = html_escaped(run.folder);
  row += "</td><td>" + (run.has_report ? fmt::format("<a href=\"{0}/report.html\">{0}</a>", name) : name) + "</td>";
  for (const auto* text : {&run.scene, &run.variant, &run.seed, &run.scale, &run.program})
    row += "<td>" + html_escaped(*text) + "</td>";
  for (std::size_t c = 0; c < columns.size(); ++c) row += value_cell(columns[c], run.values[c], run.statuses[c]);
  return row + "</tr>\n";
}

// Rows that somebody set a target for, in the order of the pipeline as `all_metrics` has it.
std::vector<BrowsedColumn> judged_columns(const ResultsIndex& index) {
  const auto rows = index.query("SELECT DISTINCT stage, metric FROM runs JOIN scores USING (run) WHERE kind = 'run'");
  std::vector<std::pair<std::size_t, BrowsedColumn>> found;
  const auto declared = all_metrics();
  for (const auto& row : rows.values) {
    const Metric* metric = find_metric(row[0], row[1]);
    if (!metric || !metric->target || !metric->judges(metric->members_of(row[1]).value())) continue;
    const auto place = std::find(declared.begin(), declared.end(), metric) - declared.begin();
    found.push_back({static_cast<std::size_t>(place), {row[0], row[1]}});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first, a.second.metric) < std::tie(b.first, b.second.metric);
  });
  std::vector<BrowsedColumn> columns;
  for (const auto& each : found) columns.push_back(each.second);
  return columns;
}

std::string thumbnail_of(const fs::path& run) {
  const cv::Mat image = cv::imread((run / "renders/result_mannequin.png").string(), cv::IMREAD_COLOR);
  if (image.empty()) return "";
  cv::Mat small;
  cv::resize(image, small, {std::max(1, image.cols * kThumbnailPx / image.rows), kThumbnailPx}, 0, 0, cv::INTER_AREA);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", small, bytes, {cv::IMWRITE_JPEG_QUALITY, 85});
  return std::string(bytes.begin(), bytes.end());
}

}  // namespace

std::string sparkline_svg(const std::vector<std::string>& values) {
  constexpr double kWidth = 90, kHeight = 18, kEdge = 2;
  std::vector<std::pair<std::size_t, double>> numbers;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!values[i].empty()) numbers.push_back({i, std::atof(values[i].c_str())});
  if (numbers.size() < 2) return "";
  double low = numbers.front().second, high = low;
  for (const auto& [at, value] : numbers) low = std::min(low, value), high = std::max(high, value);
  std::string points;
  for (const auto& [at, value] : numbers) {
    const double part = high > low ? (value - low) / (high - low) : 0.5;
    points +=
        fmt::format("{:.1f},{:.1f} ",
                    kEdge + (kWidth - 2 * kEdge) * static_cast<double>(at) / static_cast<double>(values.size() - 1),
                    kHeight - kEdge - (kHeight - 2 * kEdge) * part);
  }
  return fmt::format(
      "<svg width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"from {2:g} to {3:g} over "
      "{4} "
      "runs\"><polyline points=\"{5}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.2\"/></svg>",
      kWidth, kHeight, low, high, numbers.size(), points);
}

std::string browse_html(const std::string& title, const std::vector<BrowsedColumn>& columns,
                        const std::vector<BrowsedRun>& runs) {
  std::string heads;
  for (const char* name : {"picture", "run", "scene", "variant", "seed", "scale", "program"})
    heads += head_cell(name, "");
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<std::string> course;
    for (const auto& run : runs) course.push_back(run.values[c]);
    heads += head_cell(columns[c].stage + " " + columns[c].metric, sparkline_svg(course));
  }
  std::string rows;
  for (const auto& run : runs) rows += run_row(columns, run);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><meta http-equiv=\"Content-Security-Policy\" content=\"{}\">"
      "<title>{}</title><style>{}{}</style></head>\n<body><header><h1>{}</h1><p>{} runs, oldest first; green: target "
      "met, red: missed.</p></header>\n<main><div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"runs\">"
      "<table><thead><tr>{}</tr></thead>\n<tbody>{}</tbody></table></div></main><script>{}</script></body></html>\n",
      kPagePolicy, html_escaped(title), kPageStyle, kBrowseStyle, html_escaped(title), runs.size(), heads, rows,
      kBrowseScript);
}

int write_browse_page(const fs::path& folder) {
  const ResultsIndex index({folder});
  const auto columns = judged_columns(index);
  const auto found = index.query(
      "SELECT run, folder, scene, variant, seed, scale, program FROM runs WHERE kind = 'run' ORDER BY modified, "
      "folder");
  if (found.values.empty())
    throw InputError(folder.string(), "found no runs below it; expected folders with a scores.json");
  std::vector<BrowsedRun> runs;
  for (const auto& row : found.values) {
    BrowsedRun run;
    run.folder = fs::path(row[1]).lexically_proximate(folder).generic_string();
    run.scene = row[2], run.variant = row[3], run.seed = row[4], run.scale = row[5], run.program = row[6];
    run.has_report = fs::exists(fs::path(row[1]) / "report.html");
    run.thumbnail = thumbnail_of(row[1]);
    std::map<std::pair<std::string, std::string>, std::pair<std::string, std::string>> scores;
    for (const auto& score :
         index.query("SELECT stage, metric, value, status FROM scores WHERE run = ?", {row[0]}).values)
      scores[{score[0], score[1]}] = {score[2], score[3]};
    for (const auto& column : columns) {
      const auto& [value, status] = scores[{column.stage, column.metric}];
      run.values.push_back(status == "ok" ? value : "");
      run.statuses.push_back(status);
    }
    runs.push_back(std::move(run));
  }
  const std::string title =
      "Runs in " + fs::absolute(folder / "x").lexically_normal().parent_path().filename().string();
  write_file_atomically(folder / "index.html", browse_html(title, columns, runs));
  return static_cast<int>(runs.size());
}

}  // namespace dressform
