#include "eval/report/thesis_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/report/thesis_table_parts.h"

namespace dressform {
namespace {

using Row = ThesisTable::Row;
namespace known = thesis_figures;

const known::Garment* garment_of(const RunCounts& run, const std::string& slot) {
  const int group = thesis_group_of(run);
  if (group < 0) return nullptr;
  return slot == "top" ? &known::kShirts[known::kShirtOfGroup[group]] : &known::kBottoms[known::kBottomOfGroup[group]];
}

// A sensor's view among the thesis's four; -1 where it is not known, or another sensor has the same.
int view_of(const RunCounts& run, const std::string& sensor) {
  const auto own = run.view.find(sensor);
  if (own == run.view.end()) return -1;
  const auto same =
      std::count_if(run.view.begin(), run.view.end(), [&](const auto& v) { return v.second == own->second; });
  for (int view = 0; view < 4; ++view)
    if (own->second == known::kViews[view] && same == 1) return view;
  return -1;
}

std::string view_name(const RunCounts& run, const std::string& sensor) {
  const auto view = run.view.find(sensor);
  return view == run.view.end() ? sensor : view->second + " (" + sensor + ")";
}

std::optional<long long> found_in(const std::map<std::string, long long>& counts, const std::string& sensor) {
  const auto found = counts.find(sensor);
  return found == counts.end() ? std::nullopt : std::optional(found->second);
}

// Sensors in the tables' order of views; those without a view last.
std::vector<std::string> by_view(const RunCounts& run) {
  std::vector<std::string> sensors = run.sensors;
  const auto place = [&](const std::string& sensor) {
    const auto own = run.view.find(sensor);
    if (own == run.view.end()) return 4;
    return static_cast<int>(std::find(known::kViews, known::kViews + 4, own->second) - known::kViews);
  };
  std::stable_sort(sensors.begin(), sensors.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return sensors;
}

ThesisTable extraction(const std::vector<RunCounts>& runs) {
  ThesisTable table{
      9, "Number of interested pixels before and after dressed mannequin extraction", {"Run", "View"}, {}, {}};
  for (const auto& run : runs)
    for (const auto& sensor : by_view(run)) {
      const int group = thesis_group_of(run), view = view_of(run, sensor);
      const bool beside = group >= 0 && view >= 0;
      table.rows.push_back(
          {{run.run, view_name(run, sensor)},
           {count_figure("Dressed mannequin", found_in(run.mannequin, sensor),
                         beside ? std::optional<long long>(known::kMannequinPixels[group][view]) : std::nullopt,
                         "extract found no mannequin in this view, or it has no colour image"),
            count_figure("Original image", found_in(run.image, sensor),
                         beside ? std::optional<long long>(known::kImagePixels) : std::nullopt, "no colour camera")}});
    }
  return table;
}

// "Shirt 1" of the thesis, or the slot's own name.
std::string garment_name(const RunCounts& run, const std::string& slot) {
  const known::Garment* thesis = garment_of(run, slot);
  return thesis ? thesis->name : slot;
}

// What was not found at all is a row of "-" all the same.
const GarmentCounts& counts_of(const RunCounts& run, const std::string& slot) {
  static const GarmentCounts none = [] {
    GarmentCounts counts;
    counts.not_closed = counts.not_open = "segment found no such garment";
    return counts;
  }();
  const auto found = run.garments.find(slot);
  return found == run.garments.end() ? none : found->second;
}

ThesisTable filling(int number_of, const char* caption, const std::vector<RunCounts>& runs, const std::string& slot) {
  ThesisTable table{number_of, caption, {"Run", "Type", "View"}, {}, {}};
  for (const auto& run : runs)
    for (const auto& sensor : by_view(run)) {
      const GarmentCounts& counts = counts_of(run, slot);
      const auto pixels = counts.pixels.find(sensor);
      const int view = view_of(run, sensor);
      const known::Garment* thesis = view < 0 ? nullptr : garment_of(run, slot);
      const bool there = pixels != counts.pixels.end() && run.model_from_sensor.count(sensor);
      const std::string reason =
          pixels == counts.pixels.end() ? "segment found no such garment" : "the view was not registered";
      const long long seen = there ? pixels->second.seen : 0, filled = there ? pixels->second.filled : 0;
      table.rows.push_back(
          {{run.run, garment_name(run, slot), view_name(run, sensor)},
           {count_figure("Before region filling", there ? std::optional(seen) : std::nullopt,
                         thesis ? std::optional<long long>(thesis->pixels[view]) : std::nullopt, reason),
            count_figure("After region filling", there ? std::optional(seen + filled) : std::nullopt,
                         thesis ? std::optional<long long>(thesis->filled_pixels[view]) : std::nullopt, reason)}});
    }
  return table;
}

// A figure that the thesis gives for its garment; nothing where it has none.
std::optional<long long> figure_of(const known::Garment* thesis, int known::Garment::*field) {
  return thesis ? std::optional<long long>(thesis->*field) : std::nullopt;
}

ThesisTable cleaning(int number_of, const char* caption, const std::vector<RunCounts>& runs, const std::string& slot) {
  ThesisTable table{number_of, caption, {"Run", "Type"}, {}, {}};
  for (const auto& run : runs) {
    const GarmentCounts& counts = counts_of(run, slot);
    const known::Garment* thesis = garment_of(run, slot);
    table.rows.push_back({{run.run, garment_name(run, slot)},
                          {count_figure("Aligned point clouds", counts.points,
                                        figure_of(thesis, &known::Garment::points), counts.not_closed),
                           count_figure("After deleting outliers", counts.cleaned,
                                        figure_of(thesis, &known::Garment::cleaned_points), counts.not_closed),
                           count_figure("After surface reconstruction",
                                        counts.closed ? std::optional(counts.closed->vertices) : std::nullopt,
                                        figure_of(thesis, &known::Garment::closed_vertices), counts.not_closed)}});
  }
  return table;
}

// The thesis prints no boundary edges. They follow from its V and F: B = 2 V - F - 2 chi, where chi is 2 less the
// number of openings (4 of a shirt, 3 of trousers, 2 of a skirt).
std::optional<long long> boundary_of(const known::Garment* thesis, const std::string& slot) {
  if (!thesis) return {};
  const int openings = slot == "top" ? 4 : thesis == &known::kBottoms[3] ? 2 : 3;
  return 2LL * thesis->open_vertices - thesis->open_faces - 2 * (2 - openings);
}

ThesisTable opening(int number_of, const char* caption, const std::vector<RunCounts>& runs, const std::string& slot) {
  ThesisTable table{number_of, caption, {"Run", "Type"}, {}, {}};
  table.notes.push_back("The thesis's B follows from its V and F: B = 2 V - F - 2 chi, chi = 2 less the openings.");
  for (const auto& run : runs) {
    const GarmentCounts& counts = counts_of(run, slot);
    const known::Garment* thesis = garment_of(run, slot);
    Row row{{run.run, garment_name(run, slot)}, {}};
    const auto add = [&](const char* measure, const std::optional<MeshCounts>& mesh, long long MeshCounts::*own,
                         std::optional<long long> theirs, const std::string& why) {
      row.figures.push_back(count_figure(measure, mesh ? std::optional((*mesh).*own) : std::nullopt, theirs, why));
    };
    add("V before", counts.closed, &MeshCounts::vertices, figure_of(thesis, &known::Garment::closed_vertices),
        counts.not_closed);
    add("F before", counts.closed, &MeshCounts::faces, figure_of(thesis, &known::Garment::closed_faces),
        counts.not_closed);
    add("V after", counts.open, &MeshCounts::vertices, figure_of(thesis, &known::Garment::open_vertices),
        counts.not_open);
    add("F after", counts.open, &MeshCounts::faces, figure_of(thesis, &known::Garment::open_faces), counts.not_open);
    add("B after", counts.open, &MeshCounts::boundary_edges, boundary_of(thesis, slot), counts.not_open);
    table.rows.push_back(row);
  }
  return table;
}

// Tables 9 to 15: what extraction, filling, surface and opening made.
std::vector<ThesisTable> garment_tables(const std::vector<RunCounts>& runs) {
  return {
      extraction(runs),
      filling(10, "Number of pixels before and after region filling, shirt", runs, "top"),
      filling(11, "Number of pixels before and after region filling, trouser and skirt", runs, "bottom"),
      cleaning(
          12, "Number of points of the aligned shirt clouds, after deleting outliers, and of the vertices made of them",
          runs, "top"),
      cleaning(13,
               "Number of points of the aligned trouser and skirt clouds, after deleting outliers, and of the vertices "
               "made of them",
               runs, "bottom"),
      opening(14,
              "Vertices (V), faces (F) and boundary edges (B) of the shirt mesh before and after mesh post-processing",
              runs, "top"),
      opening(15,
              "Vertices (V), faces (F) and boundary edges (B) of the trouser and skirt mesh before and after mesh "
              "post-processing",
              runs, "bottom")};
}

// Reasons of what is missing, and what keeps the figures from being compared.
void add_notes(const std::vector<RunCounts>& runs, ThesisTable& table) {
  std::vector<std::string> reasons;
  for (const auto& row : table.rows)
    for (const auto& figure : row.figures) {
      const std::string reason = fmt::format("{}: {}.", fmt::join(row.names, ", "), figure.reason);
      if (!figure.reason.empty() && std::find(reasons.begin(), reasons.end(), reason) == reasons.end())
        reasons.push_back(reason);
    }
  table.notes.insert(table.notes.end(), reasons.begin(), reasons.end());
  const bool pixels = table.number >= 9 && table.number <= 13;
  for (const auto& run : runs) {
    if (pixels && run.scale != 1)
      table.notes.push_back(fmt::format("{}: at scale {:g} of the images, which has {:.3g} times the thesis's pixels.",
                                        run.run, run.scale, run.scale * run.scale));
    if (table.number >= 9 && thesis_group_of(run) < 0)
      table.notes.push_back(fmt::format("{}: its scene ({}) is none of the thesis's groups.", run.run, run.scene));
  }
}

}  // namespace

std::vector<ThesisTable> thesis_tables(const std::vector<RunCounts>& runs) {
  std::vector<ThesisTable> tables = calibration_tables(runs);
  for (auto& table : garment_tables(runs)) tables.push_back(std::move(table));
  for (auto& table : tables) add_notes(runs, table);
  return tables;
}

}  // namespace dressform
