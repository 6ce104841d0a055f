#include "eval/inspect/inspection.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <functional>

#include "eval/report/html.h"
#include "scenes/file_bytes.h"
#include "scenes/image_file.h"
#include "scenes/json_file.h"
#include "scenes/new_folder.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string tolerance_text(const Finding& finding) {
  if (!finding.judged()) return "";
  if (!std::isfinite(finding.low)) return fmt::format("≤ {:.4g}", finding.high);
  if (!std::isfinite(finding.high)) return fmt::format("≥ {:.4g}", finding.low);
  return fmt::format("{:.4g} to {:.4g}", finding.low, finding.high);
}

void add_findings(HtmlPage& page, const std::vector<Finding>& findings) {
  if (findings.empty()) return;
  std::vector<std::vector<HtmlPage::Cell>> rows;
  for (const auto& finding : findings)
    rows.push_back({{finding.what, ""},
                    {fmt::format("{:.4g} {}", finding.shown(), finding.unit), !finding.judged() ? ""
                                                                              : finding.good()  ? "good"
                                                                                                : "bad"},
                    {std::isfinite(finding.reference) ? fmt::format("{:.4g}", finding.reference) : "", ""},
                    {tolerance_text(finding), "quiet"},
                    {finding.samples ? std::to_string(finding.samples) : "", "quiet"}});
  page.table({"Figure", "Measured", "Reference", "Tolerance", "Pixels"}, rows);
}

std::string page_text(const Inspection& inspection) {
  HtmlPage page(inspection.title);
  page.paragraph(inspection.summary);
  const InspectionCount count = count_of(inspection);
  if (count.judged > 0)
    page.verdict(fmt::format("{} of {} judged figures within tolerance", count.good, count.judged),
                 count.good == count.judged);
  int number = 0;
  for (const auto& section : inspection.sections) {
    page.heading(section.title, "section" + std::to_string(++number));
    for (const auto& text : section.text) page.paragraph(text);
    for (const auto& figure : section.figures) page.figure(figure);
    for (const auto& chart : section.charts) page.drawing(chart.title, chart.caption, chart_svg(chart));
    add_findings(page, section.findings);
  }
  return page.text();
}

// NaN and infinities are null, as JSON has none.
ordered_json number_json(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); }

ordered_json chart_json(const Chart& chart) {
  ordered_json curves = ordered_json::array();
  for (const auto& curve : chart.curves) {
    ordered_json points = ordered_json::array();
    for (const auto& point : curve.points) points.push_back({number_json(point.x()), number_json(point.y())});
    curves.push_back({{"name", curve.name}, {"points", points}});
  }
  return {{"name", chart.name}, {"x", chart.x.label}, {"y", chart.y.label}, {"curves", curves}};
}

ordered_json statistics_json(const Inspection& inspection) {
  ordered_json findings = ordered_json::array(), charts = ordered_json::array();
  for (const auto& section : inspection.sections) {
    for (const auto& f : section.findings)
      findings.push_back({{"section", section.title},
                          {"what", f.what},
                          {"unit", f.unit},
                          {"measured", number_json(f.shown())},
                          {"reference", number_json(f.reference)},
                          {"low", number_json(f.low)},
                          {"high", number_json(f.high)},
                          {"within", f.judged() ? ordered_json(f.good()) : ordered_json()},
                          {"pixels", f.samples}});
    for (const auto& chart : section.charts) charts.push_back(chart_json(chart));
  }
  return {{"title", inspection.title}, {"findings", findings}, {"charts", charts}};
}

}  // namespace

Finding within(const std::string& what, const std::string& unit, double measured, double reference, double part,
               long samples) {
  return {what, unit, measured, reference, (1 - part) * reference, (1 + part) * reference, samples};
}

InspectionCount count_of(const Inspection& inspection) {
  InspectionCount count;
  for (const auto& section : inspection.sections) {
    count.images += static_cast<int>(section.figures.size() + section.charts.size());
    for (const auto& finding : section.findings)
      if (finding.judged()) ++count.judged, count.good += finding.good();
  }
  return count;
}

void write_inspection(const Inspection& inspection, const fs::path& folder) {
  NewFolder writer(folder);
  std::vector<std::function<void()>> jobs;
  for (const auto& section : inspection.sections) {
    for (const auto& figure : section.figures)
      jobs.push_back([&] { write_png(writer.temporary() / (figure.name + ".png"), figure.image); });
    for (const auto& chart : section.charts)
      jobs.push_back([&] {
        write_png(writer.temporary() / (chart.name + ".png"), chart_image(chart));
        write_file_atomically(writer.temporary() / (chart.name + ".svg"), chart_svg(chart));
      });
  }
  tbb::parallel_for(std::size_t(0), jobs.size(), [&](std::size_t i) { jobs[i](); });
  write_json(writer.temporary() / "statistics.json", statistics_json(inspection));
  write_file_atomically(writer.temporary() / "inspect.html", page_text(inspection));
  writer.keep();
}

}  // namespace dressform
