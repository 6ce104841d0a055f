#include "eval/inspect/sensor_charts.h"

#include <fmt/format.h>

#include <cmath>

#include "synthetic/sensors/known_scenes.h"
#include "synthetic/sensors/noise_references.h"

namespace dressform {
namespace {

using Eigen::Vector2d;

constexpr double kDegree = M_PI / 180;

bool is_v1(const SensorSetup& setup) { return setup.model == "kinect_v1"; }

// A published curve with a band of so many parts to either side (0: none).
template <class Function>
void add_reference(Chart& chart, const std::string& name, double from, double to, double part,
                   const Function& reference) {
  Curve curve{name, part > 0 ? Curve::line : Curve::dashed, 0, {}};
  Band band{fmt::format("±{:.0f} %", 100 * part), 3, {}};
  for (int i = 0; i <= 80; ++i) {
    const double x = from + (to - from) * i / 80, y = reference(x);
    curve.points.push_back({x, y});
    band.edges.push_back({x, (1 - part) * y, (1 + part) * y});
  }
  chart.curves.push_back(curve);
  if (part > 0) chart.bands.push_back(band);
}

DepthErrors facing(const SensorSetup& setup, double distance_m) {
  return is_v1(setup) ? of_plane_between_steps(setup, distance_m, 1) : of_plane(setup, distance_m, 0, kWhiteAlbedo);
}

// Mean error on a plane turned by 5 degrees, over a wide window.
double turned_plane_mm(const SensorSetup& setup, double distance_m) {
  const RayScene scene = scene_of(known_plane(distance_m, 5, 0.8f));
  const SensorFrame frame = measure_scene(scene, setup.model, setup.values, 1, 0, setup.camera);
  return plane_errors(frame.depth_mm, setup.camera, distance_m, 5, 100, 100).mean_mm;
}

}  // namespace

InspectionSection sigma_by_distance(const SensorSetup& noise) {
  const double last_m = is_v1(noise) ? 4.0 : 4.4;
  Chart chart{"sigma_distance",
              "Noise along the axis by distance",
              "Deviation of depth on a white plane that faces the sensor.",
              {"distance [m]", 0, 4.5},
              {},
              {},
              {},
              {}};
  if (is_v1(noise)) {
    add_reference(chart, "Khoshelham 2012", 0.5, 4.5, 0.15, khoshelham_sigma_mm);
    add_reference(chart, "Nguyen 2012", 0.5, 4.5, 0, [](double z) { return nguyen_sigma_mm(z, 0); });
  } else {
    add_reference(chart, "Fankhauser 2015", 0.5, 4.5, 0.15, [](double z) { return fankhauser_sigma_mm(z, 0); });
  }
  InspectionSection section{"Noise by distance", {}, {}, {}, {}};
  Curve measured{noise.model, Curve::dots, 1, {}};
  for (int quarter = 2; 0.25 * quarter <= last_m; quarter += is_v1(noise) ? 2 : 1) {
    const double z = 0.25 * quarter;
    const DepthErrors errors = facing(noise, z);
    if (errors.pixels == 0 || errors.holes > 0.05) continue;  // the range's end cuts the noise
    measured.points.push_back({z, errors.sigma_mm});
    const bool judged = is_v1(noise) ? z >= 1 && z <= 3.5 : quarter % 4 == 0;
    if (judged)
      section.findings.push_back(within(fmt::format("sigma at {:g} m", z), "mm", errors.sigma_mm,
                                        is_v1(noise) ? khoshelham_sigma_mm(z) : fankhauser_sigma_mm(z, 0), 0.15,
                                        errors.pixels));
  }
  chart.curves.push_back(measured);
  chart.y = axis_around(chart, "σ of depth [mm]");
  section.charts.push_back(chart);
  return section;
}

InspectionSection sigma_by_angle(const SensorSetup& noise) {
  Chart chart{"sigma_angle",
              "Noise along the axis by incidence, at 2 m",
              "Deviation of depth on a white plane turned about the vertical, in columns about the image's centre.",
              {"incidence θ [deg]", 0, 90},
              {"σ of depth [mm]", 1, 50, true},
              {},
              {},
              {}};
  const auto reference_mm = [&](double degrees) {
    const double theta = degrees * kDegree;
    return is_v1(noise) ? nguyen_sigma_mm(2, theta) : fankhauser_sigma_mm(2, theta);
  };
  add_reference(chart, is_v1(noise) ? "Nguyen 2012" : "Fankhauser 2015", 0, 84, is_v1(noise) ? 0 : 0.25, reference_mm);
  InspectionSection section{"Noise by incidence", {}, {}, {}, {}};
  Curve measured{noise.model, Curve::dots, 1, {}};
  for (int degrees = 0; degrees <= 80; degrees += 5) {
    const DepthErrors errors = of_plane(noise, 2, degrees, kWhiteAlbedo);
    if (errors.pixels < 50) continue;
    measured.points.push_back({degrees, errors.sigma_mm});
    if (!is_v1(noise) && degrees >= 60 && degrees % 10 == 0)
      section.findings.push_back(within(fmt::format("sigma at 2 m and {} degrees", degrees), "mm", errors.sigma_mm,
                                        reference_mm(degrees), 0.25, errors.pixels));
  }
  chart.curves.push_back(measured);
  section.charts.push_back(chart);
  return section;
}

InspectionSection sigma_by_albedo(const SensorSetup& noise) {
  Chart chart{
      "sigma_albedo",
      "Noise along the axis by albedo, at 2.1 m",
      "Deviation of depth on a facing plane; albedo in the near infrared. Whiskers: 15 %, for the darkest 25 %.",
      {"albedo", 0, 1},
      {"σ of depth [mm]", 1, 50, true},
      {},
      {},
      {}};
  InspectionSection section{"Noise by albedo", {}, {}, {}, {}};
  Curve measured{noise.model, Curve::dotted_line, 1, {}};
  for (const double albedo : {0.05, 0.08, 0.12, 0.16, 0.20, 0.30, 0.40, 0.60, 0.80, 0.95})
    if (const DepthErrors errors = of_plane(noise, 2.1, 0, static_cast<float>(albedo)); errors.pixels > 50)
      measured.points.push_back({albedo, errors.sigma_mm});
  chart.curves.push_back(measured);
  if (!is_v1(noise)) {
    Whiskers expected{"expected", 0, {}};
    for (const auto& [albedo, sigma_mm, part] :
         {std::tuple{0.40, 3.3, 0.15}, {0.20, 5.6, 0.15}, {0.12, 9.3, 0.15}, {0.05, 28.0, 0.25}}) {
      expected.marks.push_back({albedo, (1 - part) * sigma_mm, sigma_mm, (1 + part) * sigma_mm});
      const DepthErrors errors = of_plane(noise, 2.1, 0, static_cast<float>(albedo));
      section.findings.push_back(within(fmt::format("sigma at 2.1 m, albedo {:.2f}", albedo), "mm", errors.sigma_mm,
                                        sigma_mm, part, errors.pixels));
    }
    chart.whiskers.push_back(expected);
  }
  section.charts.push_back(chart);
  return section;
}

InspectionSection holes_by_angle(const SensorSetup& noise) {
  struct Expected {
    int degrees;
    double percent, tolerance;
  };
  const std::pair<double, std::vector<Expected>> albedos[] = {{0.05, {{0, 2, 2}, {60, 46, 7}, {75, 90, 5}}},
                                                              {0.12, {{0, 0, 0.1}, {60, 0.5, 1}, {75, 26, 6}}},
                                                              {0.20, {{0, 0, 0}, {60, 0, 0.2}, {75, 2, 2}}}};
  Chart chart{"holes",
              "Pixels without depth by incidence and albedo, at 2.1 m",
              "Whiskers: expected rates; their tolerances are this project's own.",
              {"incidence θ [deg]", 0, 90},
              {"pixels without depth [%]", 0, 100},
              {},
              {},
              {}};
  InspectionSection section{"Holes", {}, {}, {}, {}};
  int color = 1;
  for (const auto& [albedo, expected] : albedos) {
    Curve measured{fmt::format("{}, albedo {:.2f}", noise.model, albedo), Curve::dotted_line, color, {}};
    Whiskers whiskers{fmt::format("expected, albedo {:.2f}", albedo), color++, {}};
    for (int degrees = 0; degrees <= 85; degrees += 5) {
      const DepthErrors errors = of_plane(noise, 2.1, degrees, static_cast<float>(albedo));
      measured.points.push_back({degrees, 100 * errors.holes});
      for (const auto& at : expected) {
        if (at.degrees != degrees || is_v1(noise)) continue;
        const double low = std::max(0.0, at.percent - at.tolerance), high = at.percent + at.tolerance;
        whiskers.marks.push_back({static_cast<double>(degrees), low, at.percent, high});
        const long pixels = degrees == 0 ? 48 * 48 : 6 * 120;
        section.findings.push_back({fmt::format("holes at {} degrees, albedo {:.2f}", degrees, albedo), "%",
                                    100 * errors.holes, at.percent, low, high, pixels});
      }
    }
    chart.curves.push_back(measured);
    if (!whiskers.marks.empty()) chart.whiskers.push_back(whiskers);
  }
  section.charts.push_back(chart);
  return section;
}

InspectionSection flying_by_gap(const SensorSetup& noise) {
  Chart chart{"flying",
              "Flying pixels at a depth edge",
              "Depths that belong to neither side, per pixel of contour of a plate at 2 m; mean of four frames.",
              {"gap behind the plate [m]", 0, 2.4},
              {"flying pixels per contour pixel", 0, 1.6},
              {},
              {},
              {}};
  InspectionSection section{"Flying pixels", {}, {}, {}, {}};
  Curve measured{noise.model, Curve::dotted_line, 1, {}};
  for (const double gap_m : {0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.7, 1.0, 1.4, 2.1, 2.3}) {
    const double flying = flying_pixels(noise, gap_m);
    measured.points.push_back({gap_m, flying});
    if (is_v1(noise)) continue;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::string what = fmt::format("flying pixels at a gap of {:g} m", gap_m);
    if (gap_m >= 0.2 && gap_m <= 0.3) section.findings.push_back({what, "a contour pixel", flying, nan, 0.2, 1.4, 0});
    if (gap_m == 2.1) section.findings.push_back({what, "a contour pixel", flying, nan, 0.01, 0.24, 0});
  }
  chart.curves.push_back(measured);
  if (!is_v1(noise)) {
    chart.bands.push_back({"expected range", 3, {{0.2, 0.2, 1.4}, {0.3, 0.2, 1.4}}});
    chart.bands.push_back({"", 3, {{2.1, 0.01, 0.24}, {2.4, 0.01, 0.24}}});
  }
  section.charts.push_back(chart);
  return section;
}

InspectionSection autocorrelation(const SensorSetup& noise) {
  Chart chart{"autocorrelation",
              "Noise shared by neighbours",
              "Correlation of the noise of a pixel with that of one so many columns on; white plane at 3 m.",
              {"lag [px]", 0, 6},
              {"correlation", -0.2, 1},
              {},
              {},
              {}};
  InspectionSection section{"Correlation of neighbours", {}, {}, {}, {}};
  const auto correlation = noise_autocorrelation(noise, 6);
  Curve measured{noise.model, Curve::dotted_line, 1, {}};
  for (std::size_t lag = 0; lag < correlation.size(); ++lag)
    if (std::isfinite(correlation[lag])) measured.points.push_back({static_cast<double>(lag), correlation[lag]});
  chart.curves.push_back(measured);
  if (!is_v1(noise)) {
    Whiskers expected{"expected", 0, {}};
    for (const auto& [lag, value, tolerance] : {std::tuple{1, 0.68, 0.05}, {2, 0.31, 0.05}, {3, 0.0, 0.06}}) {
      expected.marks.push_back({static_cast<double>(lag), value - tolerance, value, value + tolerance});
      section.findings.push_back({fmt::format("autocorrelation at lag {}", lag), "", correlation[lag], value,
                                  value - tolerance, value + tolerance, 45 * 100});
    }
    chart.whiskers.push_back(expected);
  }
  section.charts.push_back(chart);
  return section;
}

InspectionSection decoding_by_distance(const SensorSetup& still) {
  SensorSetup whole_range = still;
  if (still.model != "kinect_v1") whole_range.values["minimum_m"] = 0.4, whole_range.values["maximum_m"] = 4.6;
  Chart chart{
      "decoding",
      "Decoding error without noise",
      "Largest error: facing planes at whole millimetres, every third pixel of the image. Mean: a turned plane, on "
      "which the rounding to millimetres averages out.",
      {"distance [m]", 0, 5},
      {},
      {},
      {},
      {}};
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
  if (still.model != "kinect_v1") {
    chart.bands.push_back({"< 0.5 mm", 3, {{0.5, -0.5, 0.5}, {4.5, -0.5, 0.5}}});
    section.findings.push_back({"largest decoding error, 0.5 to 4.5 m", "mm", worst_mm,
                                std::numeric_limits<double>::quiet_NaN(), 0, 0.5, pixels});
  }
  chart.y = axis_around(chart, "error of depth [mm]");
  section.findings.push_back({"pixels without depth", "%", 100 * holes, 0, 0, 0, pixels});
  section.charts.push_back(chart);
  return section;
}

InspectionSection wiggling(const SensorSetup& still) {
  SensorSetup cropped = still;  // the window that is looked at and what its filters reach, not the whole image
  cropped.camera = Camera{72, 72, 366, 366, 35.5, 35.5, {}};
  Chart chart{"wiggling",
              "Wiggling: mean error by distance",
              "A clipped 16 MHz correlation, without noise. Peak to peak between 0.7 and 4.4 m is judged.",
              {"distance [m]", 0.5, 4.5},
              {},
              {},
              {},
              {}};
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
  const auto ladder = kinect_v1_ladder(1000, 4000), found = depth_levels(noise, 1000, 4000);
  Chart chart{"levels",
              "Depths that can be measured",
              "Step from one depth that occurs to the next, on a floor that leads away from the sensor.",
              {"distance [m]", 1, 4},
              {},
              {},
              {},
              {}};
  add_reference(chart, "z² / 345489 mm", 1, 4, 0, kinect_v1_step_mm);
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
