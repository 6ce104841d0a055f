#include "eval/report/thesis_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "eval/report/thesis_figures.h"

namespace dressform {
namespace {

using Figure = ThesisTable::Figure;
using Row = ThesisTable::Row;
namespace known = thesis_figures;

const char* const kNone = "-";

// "group2" -> 1; -1 for another scene.
int group_of(const RunCounts& run) {
  for (int group = 0; group < known::kGroups; ++group)
    if (run.scene == fmt::format("group{}", group + 1)) return group;
  return -1;
}

const known::Garment* garment_of(const RunCounts& run, const std::string& slot) {
  const int group = group_of(run);
  if (group < 0) return nullptr;
  return slot == "top" ? &known::kShirts[known::kShirtOfGroup[group]] : &known::kBottoms[known::kBottomOfGroup[group]];
}

// The number of a sensor as one of the thesis's Kinects; -1 where the rig is not one of four.
int kinect_of(const RunCounts& run, const std::string& sensor) {
  if (run.sensors.size() != known::kKinects) return -1;
  return static_cast<int>(std::find(run.sensors.begin(), run.sensors.end(), sensor) - run.sensors.begin());
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

Figure number(const std::string& measure, double value, int decimals, std::optional<double> thesis) {
  return {measure, fmt::format("{:.{}f}", value, decimals), thesis ? fmt::format("{:.{}f}", *thesis, decimals) : kNone,
          ""};
}

Figure count(const std::string& measure, std::optional<long long> value, std::optional<long long> thesis,
             const std::string& reason) {
  return {measure, value ? std::to_string(*value) : kNone, thesis ? std::to_string(*thesis) : kNone,
          value ? "" : reason};
}

std::vector<std::string> sensor_names(const RunCounts& run, const std::string& sensor) {
  const int kinect = kinect_of(run, sensor);
  return {run.run, sensor + (kinect < 0 ? "" : fmt::format(" (Kinect {})", kinect + 1))};
}

ThesisTable intrinsics(int number_of, const char* caption, const std::vector<RunCounts>& runs, bool color) {
  ThesisTable table{number_of, caption, {"Run", "Sensor"}, {}, {}};
  for (const auto& run : runs)
    for (const auto& sensor : run.sensors) {
      const auto found = run.calibration.sensors.find(sensor);
      const int kinect = kinect_of(run, sensor);
      const known::Intrinsics* thesis = kinect < 0 ? nullptr : &(color ? known::kColor : known::kInfrared)[kinect];
      const bool there = found != run.calibration.sensors.end() && (!color || found->second.color);
      const Camera camera = !there ? Camera{} : color ? *found->second.color : found->second.ir;
      Row row{run.run, sensor_names(run, sensor), {}};
      const auto add = [&](const char* measure, double value, double known::Intrinsics::*theirs) {
        const auto beside = thesis ? std::optional(thesis->*theirs) : std::nullopt;
        Figure figure = number(measure, value / run.scale, 3, beside);
        if (!there) figure.value = kNone, figure.reason = "the sensor has no such camera";
        row.figures.push_back(figure);
      };
      add("fx", camera.fx, &known::Intrinsics::fx);
      add("fy", camera.fy, &known::Intrinsics::fy);
      add("Ox", (camera.cx + 0.5) - 0.5 * run.scale, &known::Intrinsics::cx);
      add("Oy", (camera.cy + 0.5) - 0.5 * run.scale, &known::Intrinsics::cy);
      table.rows.push_back(row);
    }
  return table;
}

ThesisTable steps(const std::vector<RunCounts>& runs) {
  ThesisTable table{
      6, "Extrinsic parameters of pairs of colour and infrared sensor (R by rows, T in mm)", {"Run", "Pair"}, {}, {}};
  for (const auto& run : runs)
    for (const auto& sensor : run.sensors) {
      const auto found = run.calibration.sensors.find(sensor);
      const int kinect = kinect_of(run, sensor);
      Row row{run.run, sensor_names(run, sensor), {}};
      const bool there = found != run.calibration.sensors.end() && found->second.color;
      const Isometry3d step = there ? found->second.color_from_ir : Isometry3d::Identity();
      const auto add = [&](const std::string& measure, double value, std::optional<double> thesis) {
        Figure figure = number(measure, value, 4, thesis);
        if (!there) figure.value = kNone, figure.reason = "the sensor has no colour camera";
        row.figures.push_back(figure);
      };
      const known::Step* thesis = kinect < 0 ? nullptr : &known::kColorFromInfrared[kinect];
      for (int k = 0; k < 9; ++k)
        add(fmt::format("R{}{}", k / 3 + 1, k % 3 + 1), step.linear()(k / 3, k % 3),
            thesis ? std::optional(thesis->rotation[k]) : std::nullopt);
      for (int k = 0; k < 3; ++k)
        add(fmt::format("T{}", "xyz"[k]), 1000 * step.translation()[k],
            thesis ? std::optional(thesis->translation_mm[k]) : std::nullopt);
      table.rows.push_back(row);
    }
  return table;
}

ThesisTable poses(const std::vector<RunCounts>& runs) {
  ThesisTable table{
      7, "Transformation matrix from one view to the fused model (upper three rows, m)", {"Run", "Kinect"}, {}, {}};
  table.notes.push_back(
      "Each scan has a frame of its own: only turns between views can be compared, not the numbers themselves.");
  for (const auto& run : runs)
    for (const auto& sensor : run.sensors) {
      const auto pose = run.model_from_sensor.find(sensor);
      const auto why = run.not_registered.find(sensor);
      const int kinect = kinect_of(run, sensor);
      Row row{run.run, sensor_names(run, sensor), {}};
      for (int k = 0; k < 12; ++k) {
        const bool there = pose != run.model_from_sensor.end();
        Figure figure =
            number(fmt::format("m{}{}", k / 4 + 1, k % 4 + 1), there ? pose->second.matrix()(k / 4, k % 4) : 0, 6,
                   kinect < 0 ? std::nullopt : std::optional(known::kModelFromKinect[kinect][k]));
        if (!there) {
          figure.value = kNone;
          figure.reason = "not registered" + (why == run.not_registered.end() ? "" : ": " + why->second);
        }
        row.figures.push_back(figure);
      }
      table.rows.push_back(row);
    }
  return table;
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
      const int group = group_of(run), view = view_of(run, sensor);
      const bool beside = group >= 0 && view >= 0;
      table.rows.push_back(
          {run.run,
           {run.run, view_name(run, sensor)},
           {count("Dressed mannequin", found_in(run.mannequin, sensor),
                  beside ? std::optional<long long>(known::kMannequinPixels[group][view]) : std::nullopt,
                  "extract found no mannequin in this view, or it has no colour image"),
            count("Original image", found_in(run.image, sensor),
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
          {run.run,
           {run.run, garment_name(run, slot), view_name(run, sensor)},
           {count("Before region filling", there ? std::optional(seen) : std::nullopt,
                  thesis ? std::optional<long long>(thesis->pixels[view]) : std::nullopt, reason),
            count("After region filling", there ? std::optional(seen + filled) : std::nullopt,
                  thesis ? std::optional<long long>(thesis->filled_pixels[view]) : std::nullopt, reason)}});
    }
  return table;
}

ThesisTable cleaning(int number_of, const char* caption, const std::vector<RunCounts>& runs, const std::string& slot) {
  ThesisTable table{number_of, caption, {"Run", "Type"}, {}, {}};
  for (const auto& run : runs) {
    const GarmentCounts& counts = counts_of(run, slot);
    const known::Garment* thesis = garment_of(run, slot);
    const auto theirs = [&](int known::Garment::*field) {
      return thesis ? std::optional<long long>(thesis->*field) : std::nullopt;
    };
    table.rows.push_back(
        {run.run,
         {run.run, garment_name(run, slot)},
         {count("Aligned point clouds", counts.points, theirs(&known::Garment::points), counts.not_closed),
          count("After deleting outliers", counts.cleaned, theirs(&known::Garment::cleaned_points), counts.not_closed),
          count("After surface reconstruction", counts.closed ? std::optional(counts.closed->vertices) : std::nullopt,
                theirs(&known::Garment::closed_vertices), counts.not_closed)}});
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
    Row row{run.run, {run.run, garment_name(run, slot)}, {}};
    const auto add = [&](const char* measure, const std::optional<MeshCounts>& mesh, long long MeshCounts::*own,
                         std::optional<long long> theirs, const std::string& why) {
      row.figures.push_back(count(measure, mesh ? std::optional((*mesh).*own) : std::nullopt, theirs, why));
    };
    const auto of_thesis = [&](int known::Garment::*field) {
      return thesis ? std::optional<long long>(thesis->*field) : std::nullopt;
    };
    add("V before", counts.closed, &MeshCounts::vertices, of_thesis(&known::Garment::closed_vertices),
        counts.not_closed);
    add("F before", counts.closed, &MeshCounts::faces, of_thesis(&known::Garment::closed_faces), counts.not_closed);
    add("V after", counts.open, &MeshCounts::vertices, of_thesis(&known::Garment::open_vertices), counts.not_open);
    add("F after", counts.open, &MeshCounts::faces, of_thesis(&known::Garment::open_faces), counts.not_open);
    add("B after", counts.open, &MeshCounts::boundary_edges, boundary_of(thesis, slot), counts.not_open);
    table.rows.push_back(row);
  }
  return table;
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
    if (table.number >= 9 && group_of(run) < 0)
      table.notes.push_back(fmt::format("{}: its scene ({}) is none of the thesis's groups.", run.run, run.scene));
  }
}

}  // namespace

std::vector<ThesisTable> thesis_tables(const std::vector<RunCounts>& runs) {
  std::vector<ThesisTable> tables{
      intrinsics(4, "Intrinsic parameters of the colour sensor, in pixels of the full image", runs, true),
      intrinsics(5, "Intrinsic parameters of the infrared sensor, in pixels of the full image", runs, false),
      steps(runs),
      poses(runs),
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
  for (auto& table : tables) add_notes(runs, table);
  return tables;
}

}  // namespace dressform
