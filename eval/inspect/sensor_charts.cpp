#include "eval/inspect/sensor_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "synthetic/sensors/known_scenes.h"

namespace dressform {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// What is expected of a surface of this albedo, by incidence; empty: nothing.
std::vector<ExpectedFigure> holes_expected(const SensorDevice& device, double albedo) {
  for (const auto& holes : device.holes)
    if (holes.albedo == albedo) return holes.percent_by_angle_deg;
  return {};
}

// Mean error on a plane turned by 5 degrees, over a wide window.
double turned_plane_mm(const SensorSetup& setup, double distance_m) {
  const RayScene scene = scene_of(known_plane(distance_m, 5, 0.8f));
  const SensorFrame frame = measure_scene(scene, setup.model, setup.values, 1, 0, setup.camera);
  return plane_errors(frame.depth_mm, setup.camera, distance_m, 5, 100, 100).mean_mm;
}

}  // namespace

InspectionSection holes_by_angle(const SensorSetup& noise) {
  Chart chart = empty_chart("holes", "Pixels without depth by incidence and albedo, at 2.1 m",
                            "Whiskers: expected rates; their tolerances are this project's own.",
                            {"incidence θ [deg]", 0, 90}, {"pixels without depth [%]", 0, 100});
  InspectionSection section{"Holes", {}, {}, {}, {}};
  int color = 1;
  for (const double albedo : {0.05, 0.12, 0.20}) {
    Curve measured{fmt::format("{}, albedo {:.2f}", noise.model, albedo), Curve::dotted_line, color, {}};
    Whiskers whiskers{fmt::format("expected, albedo {:.2f}", albedo), color++, {}};
    const auto expected = holes_expected(device_of(noise.model), albedo);
    for (int degrees = 0; degrees <= 85; degrees += 5) {
      const DepthErrors errors = of_plane(noise, 2.1, degrees, static_cast<float>(albedo));
      measured.points.push_back({degrees, 100 * errors.holes});
      for (const auto& at : expected) {
        if (at.at != degrees) continue;
        whiskers.marks.push_back({at.at, at.low, at.value, at.high});
        section.findings.push_back({fmt::format("holes at {} degrees, albedo {:.2f}", degrees, albedo), "%",
                                    100 * errors.holes, at.value, at.low, at.high, degrees == 0 ? 48 * 48 : 6 * 120});
      }
    }
    chart.curves.push_back(measured);
    if (!whiskers.marks.empty()) chart.whiskers.push_back(whiskers);
  }
  section.charts.push_back(chart);
  return section;
}

InspectionSection flying_by_gap(const SensorSetup& noise) {
  Chart chart =
      empty_chart("flying", "Flying pixels at a depth edge",
                  "Depths that belong to neither side, per pixel of contour of a plate at 2 m; mean of four frames.",
                  {"gap behind the plate [m]", 0, 2.4}, {"flying pixels per contour pixel", 0, 1.6});
  InspectionSection section{"Flying pixels", {}, {}, {}, {}};
  Curve measured{noise.model, Curve::dotted_line, 1, {}};
  const auto& expected = device_of(noise.model).flying_pixels;
  for (const double gap_m : {0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.7, 1.0, 1.4, 2.1, 2.3}) {
    const double flying = flying_pixels(noise, gap_m);
    measured.points.push_back({gap_m, flying});
    for (const auto& range : expected)
      if (gap_m >= range.from_gap_m && gap_m <= range.to_gap_m)
        section.findings.push_back({fmt::format("flying pixels at a gap of {:g} m", gap_m), "a contour pixel", flying,
                                    kNone, range.low, range.high, 0});
  }
  chart.curves.push_back(measured);
  for (const auto& range : expected)
    chart.bands.push_back({chart.bands.empty() ? "expected range" : "",
                           3,
                           {{range.from_gap_m, range.low, range.high}, {range.to_gap_m, range.low, range.high}}});
  section.charts.push_back(chart);
  return section;
}

InspectionSection decoding_by_distance(const SensorSetup& still) {
  SensorSetup whole_range = still;  // beyond the ends, so that nothing is cut off there
  for (const auto& [name, value] : those_it_has(still.model, {{"minimum_m", 0.4}, {"maximum_m", 4.6}}))
    whole_range.values[name] = value;
  Chart chart = empty_chart("decoding", "Decoding error without noise",
                            "Largest error: facing planes at whole millimetres, every third pixel of the image. Mean: "
                            "a turned plane, on which the rounding to millimetres averages out.",
                            {"distance [m]", 0, 5});
  InspectionSection section{"Decoding", {}, {}, {}, {}};
  Curve worst{"largest error", Curve::dotted_line, 1, {}}, mean{"mean on a turned plane", Curve::dotted_line, 2, {}};
  double worst_mm = 0, holes = 0;
  long pixels = 0;
  for (int eighth = 4; eighth <= 36; ++eighth) {
    const DepthErrors errors = decoding_errors(whole_range, 0.125 * eighth);
    worst.points.push_back({0.125 * eighth, errors.worst_mm});
    mean.points.push_back({0.125 * eighth, turned_plane_mm(whole_range, 0.125 * eighth)});
    worst_mm = std::max(worst_mm, errors.worst_mm), holes = std::max(holes, errors.holes);
    pixels += errors.pixels;
  }
  chart.curves = {worst, mean};
  if (const double limit_mm = device_of(still.model).decoding_error_mm; limit_mm > 0) {
    chart.bands.push_back(
        {fmt::format("< {:g} mm", limit_mm), 3, {{0.5, -limit_mm, limit_mm}, {4.5, -limit_mm, limit_mm}}});
    section.findings.push_back({"largest decoding error, 0.5 to 4.5 m", "mm", worst_mm, kNone, 0, limit_mm, pixels});
  }
  chart.y = axis_around(chart, "error of depth [mm]");
  section.findings.push_back({"pixels without depth", "%", 100 * holes, 0, 0, 0, pixels});
  section.charts.push_back(chart);
  return section;
}

InspectionSection wiggling(const SensorSetup& still) {
  SensorSetup cropped = still;  // the window that is looked at and what its filters reach, not the whole image
  cropped.camera = Camera{72, 72, still.camera.fx, still.camera.fy, 35.5, 35.5, {}};
  Chart chart =
      empty_chart("wiggling", "Wiggling: mean error by distance",
                  "A clipped 16 MHz correlation, without noise. Peak to peak between 0.7 and 4.4 m is judged.",
                  {"distance [m]", 0.5, 4.5});
  InspectionSection section{"Wiggling", {}, {}, {}, {}};
  int color = 1;
  for (const auto& [clip, expected_mm] : {std::pair{1.0, 0.0}, {0.9, 2.6}, {0.8, 7.7}, {0.7, 11.9}}) {
    cropped.values["clip"] = clip;
    const auto curve = wiggle_mm(cropped);
    Curve line{fmt::format("clip {:.1f}", clip), Curve::line, color++, {}};
    for (const auto& [distance_m, mean_mm] : curve) line.points.push_back({distance_m, mean_mm});
    chart.curves.push_back(line);
    section.findings.push_back({fmt::format("wiggling at clip {:.1f}, peak to peak", clip), "mm", peak_to_peak(curve),
                                expected_mm, std::max(0.0, expected_mm - 1), expected_mm + 1, 62 * 48 * 48});
  }
  chart.y = axis_around(chart, "mean error [mm]");
  section.charts.push_back(chart);
  return section;
}

InspectionSection levels(const SensorSetup& noise) {
  constexpr int kFrom_mm = 1000, kTo_mm = 4000;
  const SensorDevice& device = device_of(noise.model);
  const auto ladder = device.levels_mm(kFrom_mm, kTo_mm), found = depth_levels(noise, kFrom_mm, kTo_mm);
  Chart chart = empty_chart("levels", "Depths that can be measured",
                            "Step from one depth that occurs to the next, on a floor that leads away from the sensor.",
                            {"distance [m]", 1, 4});
  chart.curves.push_back(reference_curve("steps of " + device.name, 1, 4, device.step_mm, Curve::dashed));
  Curve steps{"steps that occur", Curve::dots, 1, {}};
  for (auto low = found.begin(); low != found.end() && std::next(low) != found.end(); ++low) {
    const int high = *std::next(low);
    steps.points.push_back({0.0005 * (*low + high), static_cast<double>(high - *low)});
  }
  chart.curves.push_back(steps);
  chart.y = axis_around(chart, "step [mm]");
  long common = 0;
  for (const int level : found) common += static_cast<long>(ladder.count(level));
  InspectionSection section{"Ladder of depths", {}, {}, {chart}, {}};
  const double expected = static_cast<double>(ladder.size());
  section.findings.push_back(
      {"levels between 1 and 4 m", "", static_cast<double>(found.size()), expected, expected, expected, 640 * 480});
  section.findings.push_back(
      {"of them on the ladder", "", static_cast<double>(common), expected, expected, expected, 640 * 480});
  return section;
}

}  // namespace dressform
