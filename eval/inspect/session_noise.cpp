#include "eval/inspect/session_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/inspect/depth_edges.h"
#include "eval/inspect/noise_views.h"
#include "scenes/devices/device.h"

namespace dressform {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kFacing = 30 * kDegree;
constexpr int kLeastWindows = 8;        // for a point of a chart
constexpr int kEveryMillimetre = 1500;  // of the 3000 between 1 and 4 m: more are no steps
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// What the device's published noise is at an incidence; NaN where nothing was published.
double reference_mm(const SensorDevice* device, double z_m, double theta_rad) {
  const PublishedNoise* curve = device ? device->noise_by_angle() : nullptr;
  return curve ? curve->sigma_mm(z_m, theta_rad) : kNone;
}

Finding plain(const std::string& what, const std::string& unit, double measured, double reference, long pixels) {
  Finding finding;
  finding.what = what, finding.unit = unit, finding.measured = measured;
  finding.reference = reference, finding.samples = pixels;
  return finding;
}

void add_distance_chart(InspectionSection& section, const std::string& model, const Windows& windows) {
  Chart chart = empty_chart(
      "noise_distance_" + model, "Noise by distance, surfaces within 30 degrees of facing",
      "Median over windows of 15 x 15 pixels, by half metres. Unjudged: the scene's albedo and roughness are in "
      "it, and noise that many neighbours share goes into the windows' planes.",
      {"distance [m]", 0, 5});
  const SensorDevice* device = find_device(model);
  if (device)
    for (const auto& curve : device->noise)
      chart.curves.push_back(reference_curve(
          curve.name, 0.5, 5, [&](double z) { return curve.sigma_mm(z, 0); },
          chart.curves.empty() ? Curve::line : Curve::dashed));
  int color = 1;
  for (const auto& [name, kind] :
       {std::pair("from pixel to pixel", &windows.space), {"from frame to frame", &windows.time}}) {
    Curve curve{name, Curve::dotted_line, color++, {}};
    for (double from_m = 0; from_m < 5; from_m += 0.5) {
      const auto part = chosen(*kind, from_m, from_m + 0.5, 0, kFacing);
      if (static_cast<int>(part.size()) < kLeastWindows) continue;
      double z_m = 0;
      for (const auto& window : part) z_m += window.z_m / part.size();
      const double sigma_mm = median_sigma_mm(part);
      curve.points.push_back({z_m, sigma_mm});
      section.findings.push_back(plain(fmt::format("sigma {}, {:.1f} to {:.1f} m", name, from_m, from_m + 0.5), "mm",
                                       sigma_mm, reference_mm(device, z_m, 0), pixels_of(part)));
    }
    if (!curve.points.empty()) chart.curves.push_back(curve);
  }
  chart.y = axis_around(chart, "σ of depth [mm]");
  section.charts.push_back(chart);
}

// Of the metre of distance that most windows lie in.
void add_angle_chart(InspectionSection& section, const std::string& model, const Windows& windows) {
  double from_m = 0;
  std::size_t most = 0;
  for (double at = 0; at < 5; at += 0.5)
    if (const std::size_t count = chosen(windows.space, at, at + 1, 0, M_PI / 2).size(); count > most)
      most = count, from_m = at;
  if (most == 0) return;
  double z_m = 0;
  for (const auto& window : chosen(windows.space, from_m, from_m + 1, 0, M_PI / 2)) z_m += window.z_m / most;
  Chart chart = empty_chart(
      "noise_angle_" + model, fmt::format("Noise by incidence, {:.1f} to {:.1f} m", from_m, from_m + 1),
      fmt::format(
          "Median over windows of 15 x 15 pixels, by 10 degrees; the curve is for their mean distance, {:.2f} m.", z_m),
      {"incidence θ [deg]", 0, 90}, {"σ of depth [mm]", 0.5, 50, true});
  const SensorDevice* device = find_device(model);
  const PublishedNoise* reference = device ? device->noise_by_angle() : nullptr;
  if (reference)
    chart.curves.push_back(reference_curve(
        reference->name, 0, 85, [&](double degrees) { return reference->sigma_mm(z_m, degrees * kDegree); }));
  int color = 1;
  for (const auto& [name, kind] :
       {std::pair("from pixel to pixel", &windows.space), {"from frame to frame", &windows.time}}) {
    Curve curve{name, Curve::dotted_line, color++, {}};
    for (int degrees = 0; degrees < 90; degrees += 10) {
      const auto part = chosen(*kind, from_m, from_m + 1, degrees * kDegree, (degrees + 10) * kDegree);
      if (static_cast<int>(part.size()) < kLeastWindows) continue;
      double theta_rad = 0;
      for (const auto& window : part) theta_rad += window.theta_rad / part.size();
      curve.points.push_back({theta_rad / kDegree, median_sigma_mm(part)});
      section.findings.push_back(plain(fmt::format("sigma {}, {} to {} degrees", name, degrees, degrees + 10), "mm",
                                       median_sigma_mm(part), reference_mm(device, z_m, theta_rad), pixels_of(part)));
    }
    if (!curve.points.empty()) chart.curves.push_back(curve);
  }
  section.charts.push_back(chart);
}

void add_correlation_chart(InspectionSection& section, const std::string& model, const Windows& windows) {
  const auto facing = chosen(windows.space, 0, 100, 0, kFacing);
  if (static_cast<int>(facing.size()) < kLeastWindows) return;
  Chart chart =
      empty_chart("noise_correlation_" + model, "Noise shared by neighbours, facing surfaces",
                  "Correlation of residuals so many columns apart, pooled over windows; the plane takes away a little.",
                  {"lag [px]", 0, 4}, {"correlation", -0.2, 1});
  std::vector<ExpectedFigure> expected;
  if (const SensorDevice* device = find_device(model)) expected = device->correlation;
  Curve curve{"from pixel to pixel", Curve::dotted_line, 1, {}};
  for (int lag = 0; lag <= kNoiseLags; ++lag) {
    double product = 0, square = 0;
    for (const auto& window : facing)  // every window counts the same, near or far
      if (window.products_mm2[0] > 0) product += window.products_mm2[lag] / window.products_mm2[0], square += 1;
    if (square == 0) return;  // no noise at all
    curve.points.push_back({static_cast<double>(lag), product / square});
    const auto known =
        std::find_if(expected.begin(), expected.end(), [&](const auto& figure) { return figure.at == lag; });
    if (lag > 0)
      section.findings.push_back(plain(fmt::format("autocorrelation at lag {}", lag), "", product / square,
                                       known == expected.end() ? kNone : known->value, pixels_of(facing)));
  }
  chart.curves.push_back(curve);
  Whiskers target{"sensor model's target", 0, {}};
  for (const auto& figure : expected) target.marks.push_back({figure.at, figure.low, figure.value, figure.high});
  if (!expected.empty()) chart.whiskers.push_back(target);
  section.charts.push_back(chart);
}

void add_edge_chart(InspectionSection& section, const std::string& model, const ModelViews& views) {
  std::vector<DepthEdges> edges;
  for (const auto& view : views.views) count_edges(view.frames.front(), edges);
  Chart chart = empty_chart("edges_" + model, "Depth edges",
                            "Pixels between two surfaces in a row of the image, per crossing of a contour.",
                            {"step in depth [m]", 0.1, 3.2, true});
  Curve flying{"flying: depth of neither side", Curve::dotted_line, 1, {}}, lost{"no depth", Curve::dotted_line, 2, {}};
  for (const auto& edge : edges) {
    if (edge.crossings < 30) continue;
    const double at = std::isfinite(edge.to_m) ? std::sqrt(edge.from_m * edge.to_m) : 1.4 * edge.from_m;
    const double count = static_cast<double>(edge.crossings);
    flying.points.push_back({at, edge.flying / count});
    lost.points.push_back({at, edge.lost / count});
    section.findings.push_back(plain(std::isfinite(edge.to_m)
                                         ? fmt::format("flying pixels, steps of {:g} to {:g} m", edge.from_m, edge.to_m)
                                         : fmt::format("flying pixels, steps over {:g} m", edge.from_m),
                                     "a crossing", edge.flying / count, kNone, edge.crossings));
  }
  if (flying.points.empty()) return;
  chart.curves = {flying, lost};
  chart.y = axis_around(chart, "pixels per crossing");
  section.charts.push_back(chart);
}

// Only where not every millimetre occurs: structured light, or depth kept in coarser steps.
void add_level_chart(InspectionSection& section, const std::string& model, const ModelViews& views) {
  std::vector<long> counts(65536);
  for (const auto& view : views.views)
    for (const auto& frame : view.frames)
      for (int y = 0; y < frame.rows; ++y)
        for (int x = 0; x < frame.cols; ++x) ++counts[frame.at<std::uint16_t>(y, x)];
  Curve steps{"steps that occur", Curve::dots, 1, {}};
  int before = 0, levels = 0;
  for (int mm = 1000; mm <= 4000; ++mm) {
    if (counts[mm] == 0) continue;
    if (before) steps.points.push_back({0.0005 * (before + mm), static_cast<double>(mm - before)});
    before = mm, ++levels;
  }
  if (levels < 20) return;
  const SensorDevice* device = find_device(model);
  const bool stepped = device && device->levels_mm;
  section.findings.push_back(plain("depths that occur between 1 and 4 m", "", levels,
                                   stepped ? static_cast<double>(device->levels_mm(1000, 4000).size()) : kNone, 0));
  if (levels > kEveryMillimetre && !stepped) return;
  Chart chart = empty_chart("levels_" + model, "Depths that occur",
                            "Step from one depth that occurs in the session to the next.", {"distance [m]", 1, 4});
  if (stepped) chart.curves.push_back(reference_curve("steps of " + model, 1, 4, device->step_mm));
  chart.curves.push_back(steps);
  chart.y = axis_around(chart, "step [mm]");
  section.charts.push_back(chart);
}

std::string summary_of(const std::string& model, const ModelViews& views, const Windows& windows) {
  std::string text = fmt::format("{} depth frames. Noise from pixel to pixel: {} smooth windows, {} pixels.",
                                 views.frames, windows.space.size(), pixels_of(windows.space));
  if (views.repeated > 0)
    text += fmt::format(
        " From frame to frame: {} frames of views that were taken more than once (a rig's naked and dressed "
        "shots show the same room), {} windows, {} pixels.",
        views.repeated, windows.time.size(), pixels_of(windows.time));
  else
    text += " No view was taken more than once, so noise from frame to frame is not known.";
  if (views.copies > 0)
    text += fmt::format(
        " {} frames are identical to an earlier one of their view, bit for bit, and were left out: copies "
        "tell nothing of noise.",
        views.copies);
  if (views.nominal) text += " Not calibrated: the usual camera of this image size.";
  if (const SensorDevice* device = find_device(model); !device || device->noise.empty())
    text += " No published curve for this sensor.";
  return text;
}

}  // namespace

std::vector<InspectionSection> noise_sections(const CaptureSession& session) {
  std::vector<InspectionSection> sections;
  for (const auto& [model, views] : views_by_model(session)) {
    const Windows windows = windows_of(views);
    InspectionSection section{"Noise of " + model, {summary_of(model, views, windows)}, {}, {}, {}};
    if (!windows.space.empty()) {
      add_distance_chart(section, model, windows);
      add_angle_chart(section, model, windows);
      add_correlation_chart(section, model, windows);
    }
    add_edge_chart(section, model, views);
    add_level_chart(section, model, views);
    sections.push_back(section);
  }
  return sections;
}

}  // namespace dressform
