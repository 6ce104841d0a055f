#include <fmt/format.h>

#include <algorithm>

#include "eval/report/thesis_table_parts.h"

namespace dressform {
namespace {

using Row = ThesisTable::Row;
namespace known = thesis_figures;

const std::string kNoFigure = "-";

ThesisTable intrinsics(int number_of, const char* caption, const std::vector<RunCounts>& runs, bool color) {
  ThesisTable table{number_of, caption, {"Run", "Sensor"}, {}, {}};
  for (const auto& run : runs)
    for (const auto& sensor : run.sensors) {
      const auto found = run.calibration.sensors.find(sensor);
      const int kinect = thesis_kinect_of(run, sensor);
      const known::Intrinsics* thesis = kinect < 0 ? nullptr : &(color ? known::kColor : known::kInfrared)[kinect];
      const bool there = found != run.calibration.sensors.end() && (!color || found->second.color);
      const Camera camera = !there ? Camera{} : color ? *found->second.color : found->second.ir;
      Row row{sensor_names(run, sensor), {}};
      const auto add = [&](const char* measure, double value, double known::Intrinsics::*theirs) {
        row.figures.push_back(number_figure(measure, there ? std::optional(value / run.scale) : std::nullopt, 3,
                                            thesis ? std::optional(thesis->*theirs) : std::nullopt,
                                            "the sensor has no such camera"));
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
      const int kinect = thesis_kinect_of(run, sensor);
      Row row{sensor_names(run, sensor), {}};
      const bool there = found != run.calibration.sensors.end() && found->second.color;
      const Isometry3d step = there ? found->second.color_from_ir : Isometry3d::Identity();
      const auto add = [&](const std::string& measure, double value, std::optional<double> theirs) {
        row.figures.push_back(number_figure(measure, there ? std::optional(value) : std::nullopt, 4, theirs,
                                            "the sensor has no colour camera"));
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
      const int kinect = thesis_kinect_of(run, sensor);
      Row row{sensor_names(run, sensor), {}};
      const bool there = pose != run.model_from_sensor.end();
      const std::string reason = "not registered" + (why == run.not_registered.end() ? "" : ": " + why->second);
      for (int k = 0; k < 12; ++k)
        row.figures.push_back(
            number_figure(fmt::format("m{}{}", k / 4 + 1, k % 4 + 1),
                          there ? std::optional(pose->second.matrix()(k / 4, k % 4)) : std::nullopt, 6,
                          kinect < 0 ? std::nullopt : std::optional(known::kModelFromKinect[kinect][k]), reason));
      table.rows.push_back(row);
    }
  return table;
}

}  // namespace

int thesis_group_of(const RunCounts& run) {
  for (int group = 0; group < known::kGroups; ++group)
    if (run.scene == fmt::format("group{}", group + 1)) return group;
  return -1;
}

int thesis_kinect_of(const RunCounts& run, const std::string& sensor) {
  if (run.sensors.size() != known::kKinects) return -1;
  return static_cast<int>(std::find(run.sensors.begin(), run.sensors.end(), sensor) - run.sensors.begin());
}

std::vector<std::string> sensor_names(const RunCounts& run, const std::string& sensor) {
  const int kinect = thesis_kinect_of(run, sensor);
  return {run.run, sensor + (kinect < 0 ? "" : fmt::format(" (Kinect {})", kinect + 1))};
}

ThesisTable::Figure number_figure(const std::string& measure, std::optional<double> value, int decimals,
                                  std::optional<double> thesis, const std::string& reason) {
  const auto text = [&](const std::optional<double>& number) {
    return number ? fmt::format("{:.{}f}", *number, decimals) : kNoFigure;
  };
  return {measure, text(value), text(thesis), value ? "" : reason};
}

ThesisTable::Figure count_figure(const std::string& measure, std::optional<long long> value,
                                 std::optional<long long> thesis, const std::string& reason) {
  const auto text = [](const std::optional<long long>& count) { return count ? std::to_string(*count) : kNoFigure; };
  return {measure, text(value), text(thesis), value ? "" : reason};
}

std::vector<ThesisTable> calibration_tables(const std::vector<RunCounts>& runs) {
  return {intrinsics(4, "Intrinsic parameters of the colour sensor, in pixels of the full image", runs, true),
          intrinsics(5, "Intrinsic parameters of the infrared sensor, in pixels of the full image", runs, false),
          steps(runs), poses(runs)};
}

}  // namespace dressform
