#include "eval/figures/write_figures.h"

#include <fmt/format.h>

#include "eval/figures/study_figures.h"
#include "scenes/file_bytes.h"
#include "scenes/new_folder.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

std::string table_text(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? "\\|" : std::string(1, c);
  return result;
}

}  // namespace

std::string figures_markdown(const std::string& title, const std::vector<FigureRecord>& records) {
  std::string text = "# " + title + "\n\n| figure | name | stage | shows | files |\n|---|---|---|---|---|\n";
  for (const auto& record : records) {
    const std::string files =
        record.reason.empty() ? fmt::format("{}", fmt::join(record.files, ", ")) : "none: " + record.reason;
    text += fmt::format("| {} | {} | {} | {} | {} |\n", record.number, table_text(record.name), record.stage,
                        table_text(record.shows), table_text(files));
  }
  return text;
}

std::vector<FigureRecord> write_thesis_figures(const FigureInput& input,
                                               const std::vector<const ThesisFigure*>& figures,
                                               const FigureFiles& files, const fs::path& folder) {
  NewFolder writer(folder);
  std::vector<FigureRecord> records;
  for (const auto* figure : figures) {  // one after the other: one renderer, and a figure's pictures are large
    const MadeFigure made = made_figure(*figure, input);
    FigureRecord record{figure->number, figure->name, figure->stage, figure->shows, made.reason, {}};
    if (made.figure)
      record.files =
          write_sheet(panel_sheet(*made.figure), writer.temporary(), figure->stem(), files.formats, files.dpi);
    records.push_back(record);
  }
  write_file_atomically(writer.temporary() / "figures.md", figures_markdown("Figures of " + input.scene, records));
  writer.keep();
  return records;
}

std::vector<FigureRecord> write_study_figures(const fs::path& study, const FigureFiles& files, const fs::path& folder) {
  const StudyResults results = read_results(study);
  NewFolder writer(folder);
  std::vector<FigureRecord> records;
  for (const auto& figure : study_figures(results, kPaperStyle)) {
    FigureRecord record{"-", figure.stem, "study", figure.shows, figure.reason, {}};
    if (figure.reason.empty())
      record.files = write_sheet(figure.sheet, writer.temporary(), figure.stem, files.formats, files.dpi);
    records.push_back(record);
  }
  const std::string title = "Figures of the study " + results.plan.study.name;
  write_file_atomically(writer.temporary() / "figures.md", figures_markdown(title, records));
  writer.keep();
  return records;
}

}  // namespace dressform
