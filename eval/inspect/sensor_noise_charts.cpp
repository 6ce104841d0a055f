#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/inspect/sensor_charts.h"

namespace dressform {
namespace {

constexpr double kDegree = M_PI / 180;

// A published curve, with a band of so many parts to either side where a model is judged by it.
template <class Function>
void add_reference(Chart& chart, const std::string& name, double from, double to, double part,
                   const Function& reference) {
  chart.curves.push_back(reference_curve(name, from, to, reference, part > 0 ? Curve::line : Curve::dashed));
  if (part == 0) return;
  Band band{fmt::format("±{:.0f} %", 100 * part), 3, {}};
  for (const auto& point : chart.curves.back().points)
    band.edges.push_back({point.x(), (1 - part) * point.y(), (1 + part) * point.y()});
  chart.bands.push_back(band);
}

bool judged_at(const std::vector<double>& places, double place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

// Figures and marks of what is known at single places.
void hold_to(const ExpectedFigure& expected, const std::string& what, const std::string& unit, double measured,
             long pixels, Whiskers& marks, InspectionSection& section) {
  marks.marks.push_back({expected.at, expected.low, expected.value, expected.high});
  section.findings.push_back({what, unit, measured, expected.value, expected.low, expected.high, pixels});
}

}  // namespace

InspectionSection sigma_by_distance(const SensorSetup& noise) {
  const SensorDevice& device = device_of(noise.model);
  Chart chart = empty_chart("sigma_distance", "Noise along the axis by distance",
                            "Deviation of depth on a white plane that faces the sensor.", {"distance [m]", 0, 4.5});
  for (const auto& curve : device.noise)
    add_reference(chart, curve.name, 0.5, 4.5, curve.part_by_distance, [&](double z) { return curve.sigma_mm(z, 0); });
  InspectionSection section{"Noise by distance", {}, {}, {}, {}};
  Curve measured{noise.model, Curve::dots, 1, {}};
  const double step_m = device.step_mm ? 0.5 : 0.25;  // four planes a place where steps are averaged over
  for (double z = 0.5; z <= 4.4; z += step_m) {
    const DepthErrors errors =
        device.step_mm ? of_plane_between_steps(noise, z, 1) : of_plane(noise, z, 0, kWhiteAlbedo);
    if (errors.pixels == 0 || errors.holes > 0.05) continue;  // the range's end cuts the noise
    measured.points.push_back({z, errors.sigma_mm});
    if (!judged_at(device.noise_distances_m, z)) continue;
    const PublishedNoise& curve = device.noise.front();
    section.findings.push_back(within(fmt::format("sigma at {:g} m", z), "mm", errors.sigma_mm, curve.sigma_mm(z, 0),
                                      curve.part_by_distance, errors.pixels));
  }
  chart.curves.push_back(measured);
  chart.y = axis_around(chart, "σ of depth [mm]");
  section.charts.push_back(chart);
  return section;
}

InspectionSection sigma_by_angle(const SensorSetup& noise) {
  const SensorDevice& device = device_of(noise.model);
  Chart chart =
      empty_chart("sigma_angle", "Noise along the axis by incidence, at 2 m",
                  "Deviation of depth on a white plane turned about the vertical, in columns about the image's centre.",
                  {"incidence θ [deg]", 0, 90}, {"σ of depth [mm]", 1, 50, true});
  const PublishedNoise* curve = device.noise_by_angle();
  const auto reference_mm = [&](double degrees) { return curve->sigma_mm(2, degrees * kDegree); };
  if (curve) add_reference(chart, curve->name, 0, 84, curve->part_by_angle, reference_mm);
  InspectionSection section{"Noise by incidence", {}, {}, {}, {}};
  Curve measured{noise.model, Curve::dots, 1, {}};
  for (int degrees = 0; degrees <= 80; degrees += 5) {
    const DepthErrors errors = of_plane(noise, 2, degrees, kWhiteAlbedo);
    if (errors.pixels < 50) continue;
    measured.points.push_back({degrees, errors.sigma_mm});
    for (const int judged : device.noise_angles_deg)
      if (judged == degrees)
        section.findings.push_back(within(fmt::format("sigma at 2 m and {} degrees", degrees), "mm", errors.sigma_mm,
                                          reference_mm(degrees), curve->part_by_angle, errors.pixels));
  }
  chart.curves.push_back(measured);
  section.charts.push_back(chart);
  return section;
}

InspectionSection sigma_by_albedo(const SensorSetup& noise) {
  Chart chart =
      empty_chart("sigma_albedo", "Noise along the axis by albedo, at 2.1 m",
                  "Deviation of depth on a facing plane; albedo in the near infrared. Whiskers: what is expected.",
                  {"albedo", 0, 1}, {"σ of depth [mm]", 1, 50, true});
  InspectionSection section{"Noise by albedo", {}, {}, {}, {}};
  Curve measured{noise.model, Curve::dotted_line, 1, {}};
  for (const double albedo : {0.05, 0.08, 0.12, 0.16, 0.20, 0.30, 0.40, 0.60, 0.80, 0.95})
    if (const DepthErrors errors = of_plane(noise, 2.1, 0, static_cast<float>(albedo)); errors.pixels > 50)
      measured.points.push_back({albedo, errors.sigma_mm});
  chart.curves.push_back(measured);
  Whiskers marks{"expected", 0, {}};
  for (const auto& expected : device_of(noise.model).noise_by_albedo_mm) {
    const DepthErrors errors = of_plane(noise, 2.1, 0, static_cast<float>(expected.at));
    hold_to(expected, fmt::format("sigma at 2.1 m, albedo {:.2f}", expected.at), "mm", errors.sigma_mm, errors.pixels,
            marks, section);
  }
  if (!marks.marks.empty()) chart.whiskers.push_back(marks);
  section.charts.push_back(chart);
  return section;
}

InspectionSection autocorrelation(const SensorSetup& noise) {
  constexpr int kLags = 6;
  Chart chart =
      empty_chart("autocorrelation", "Noise shared by neighbours",
                  "Correlation of the noise of a pixel with that of one so many columns on; white plane at 3 m.",
                  {"lag [px]", 0, kLags}, {"correlation", -0.2, 1});
  InspectionSection section{"Correlation of neighbours", {}, {}, {}, {}};
  const auto correlation = noise_autocorrelation(noise, kLags);
  Curve measured{noise.model, Curve::dotted_line, 1, {}};
  for (int lag = 0; lag <= kLags; ++lag)
    if (std::isfinite(correlation[lag])) measured.points.push_back({static_cast<double>(lag), correlation[lag]});
  chart.curves.push_back(measured);
  Whiskers marks{"expected", 0, {}};
  for (const auto& expected : device_of(noise.model).correlation) {
    const int lag = static_cast<int>(expected.at);
    hold_to(expected, fmt::format("autocorrelation at lag {}", lag), "", correlation[lag], 45 * 100, marks, section);
  }
  if (!marks.marks.empty()) chart.whiskers.push_back(marks);
  section.charts.push_back(chart);
  return section;
}

}  // namespace dressform
