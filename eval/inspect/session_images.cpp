#include "eval/inspect/session_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "render/color_map.h"
#include "render/renderer.h"

namespace dressform {
namespace {

struct Titled {
  std::string title;
  cv::Mat image;
};

// Up to `columns` images a row, each `height` high, with its title above it.
cv::Mat sheet(const std::vector<Titled>& images, int columns, int height) {
  std::vector<cv::Mat> rows, row;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const cv::Mat small = side_by_side({images[i].image}, height);
    row.push_back(titled(small, images[i].title));
    if (static_cast<int>(row.size()) < columns && i + 1 < images.size()) continue;
    rows.push_back(side_by_side(row, height + 22));
    row.clear();
  }
  return stacked(rows);
}

struct Range {
  double from_m = 0.5, to_m = 4.5;
};
// Of all depth in the images, but for the outermost hundredth on either side; to a tenth of a metre.
Range range_of(const std::vector<const cv::Mat*>& images) {
  std::vector<std::uint16_t> values;
  for (const auto* image : images)
    for (int y = 0; y < image->rows; y += 4)
      for (int x = 0; x < image->cols; x += 4)
        if (const auto mm = image->at<std::uint16_t>(y, x)) values.push_back(mm);
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const double low = std::floor(0.01 * values[values.size() / 100]) / 10,
               high = std::ceil(0.01 * values[values.size() - 1 - values.size() / 100]) / 10;
  return {low, std::max(high, low + 0.1)};
}

// In the colours of the colour bar; no depth is black.
cv::Mat depth_colors(const cv::Mat& depth_mm, const Range& range) {
  cv::Mat scaled, grey, colors;
  const double factor = 255 / (1000 * (range.to_m - range.from_m));
  depth_mm.convertTo(scaled, CV_8U, factor, -factor * 1000 * range.from_m);
  cv::cvtColor(scaled, grey, cv::COLOR_GRAY2BGR);
  cv::LUT(grey, scalar_colors(), colors);
  colors.setTo(cv::Scalar::all(0), depth_mm == 0);
  return colors;
}

cv::Mat index_colors(const cv::Mat& index) {
  cv::Mat colors(index.size(), CV_8UC3, cv::Scalar::all(40));
  const cv::Scalar bodies[] = {{60, 160, 230}, {90, 190, 80},  {200, 120, 60},
                               {190, 90, 190}, {80, 200, 220}, {220, 200, 90}};
  for (int body = 0; body < 6; ++body) colors.setTo(bodies[body], index == body);
  return colors;
}

Figure depth_figure(const std::string& name, const std::string& title, const std::vector<std::string>& titles,
                    const std::vector<const cv::Mat*>& images, int columns, int height) {
  const Range range = range_of(images);
  std::vector<Titled> colored;
  for (std::size_t i = 0; i < images.size(); ++i) colored.push_back({titles[i], depth_colors(*images[i], range)});
  return {name, title, "Metres along the axis; black: no depth.",
          with_color_bar(sheet(colored, columns, height), range.from_m, range.to_m, "m", "depth")};
}

InspectionSection shots_section(const std::string& name, const std::vector<std::string>& sensors,
                                const std::map<std::string, Shot>& shots) {
  InspectionSection section{
      name == "naked" ? "Shots of the naked mannequin" : "Shots of the dressed mannequin", {}, {}, {}, {}};
  std::vector<Titled> color, infrared, bodies;
  std::vector<std::string> titles;
  std::vector<const cv::Mat*> depth;
  for (const auto& sensor : sensors) {
    const auto found = shots.find(sensor);
    if (found == shots.end()) continue;
    const Shot& shot = found->second;
    titles.push_back(sensor);
    depth.push_back(&shot.depth_mm);
    if (!shot.color.empty()) color.push_back({sensor, shot.color});
    if (!shot.ir.empty()) infrared.push_back({sensor, infrared_image(shot.ir)});
    if (!shot.body_index.empty()) bodies.push_back({sensor, index_colors(shot.body_index)});
  }
  if (!color.empty()) section.figures.push_back({name + "_color", "Colour", "As captured.", sheet(color, 2, 340)});
  section.figures.push_back(depth_figure(name + "_depth", "Depth", titles, depth, 4, 300));
  if (!infrared.empty())
    section.figures.push_back(
        {name + "_ir", "Infrared", "Stretched to the 99th percentile of each.", sheet(infrared, 4, 300)});
  if (!bodies.empty())
    section.figures.push_back(
        {name + "_body_index", "Body index", "One colour a body; dark: none.", sheet(bodies, 4, 300)});
  for (std::size_t i = 0; i < depth.size(); ++i)
    section.findings.push_back({"pixels without depth, " + name + " " + titles[i], "%",
                                100 * (1 - cv::countNonZero(*depth[i]) / static_cast<double>(depth[i]->total())),
                                std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity(), static_cast<long>(depth[i]->total())});
  return section;
}

// Up to `most` places in a series, evenly spread, the first and the last among them.
std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> places;
  const std::size_t taken = std::min(count, most);
  for (std::size_t i = 0; i < taken; ++i) places.push_back(taken < 2 ? 0 : i * (count - 1) / (taken - 1));
  return places;
}

InspectionSection scan_section(const std::string& name, const DepthScan& scan) {
  std::vector<std::string> titles;
  std::vector<const cv::Mat*> images;
  for (const std::size_t i : spread(scan.depth_mm.size(), 12)) {
    titles.push_back(fmt::format("{:04d}", i));
    images.push_back(&scan.depth_mm[i]);
  }
  InspectionSection section{name == "scan_naked" ? "Scan of the mannequin" : "Scan of the user", {}, {}, {}, {}};
  section.text.push_back(fmt::format("{} frames of {}.", scan.depth_mm.size(), scan.sensor));
  section.figures.push_back(depth_figure(name, "Depth", titles, images, 6, 170));
  return section;
}

InspectionSection boards_section(const std::string& sensor, const Boards& boards) {
  const auto& shots = boards.shots.at(sensor);
  InspectionSection section{"Boards of " + sensor, {}, {}, {}, {}};
  section.text.push_back(fmt::format("{} shots of a board of {} x {} inner corners, {:g} mm a square.", shots.size(),
                                     boards.inner_corners_x, boards.inner_corners_y, 1000 * boards.square_m));
  std::vector<Titled> color, infrared;
  std::vector<std::string> titles;
  std::vector<const cv::Mat*> depth;
  for (const std::size_t i : spread(shots.size(), 6)) {
    titles.push_back(fmt::format("{:02d}", i));
    color.push_back({titles.back(), shots[i].color});
    infrared.push_back({titles.back(), infrared_image(shots[i].ir)});
    depth.push_back(&shots[i].depth_mm);
  }
  const std::string name = "boards_" + sensor;
  section.figures.push_back({name + "_color", "Colour", "As captured.", sheet(color, 3, 230)});
  section.figures.push_back(
      {name + "_ir", "Infrared", "Stretched to the 99th percentile of each.", sheet(infrared, 3, 300)});
  section.figures.push_back(depth_figure(name + "_depth", "Depth", titles, depth, 3, 300));
  return section;
}

}  // namespace

std::vector<InspectionSection> stream_sections(const CaptureSession& session) {
  std::vector<InspectionSection> sections;
  if (!session.naked.empty()) sections.push_back(shots_section("naked", session.sensors, session.naked));
  if (!session.dressed.empty()) sections.push_back(shots_section("dressed", session.sensors, session.dressed));
  for (const auto& [name, scan] : session.scans) sections.push_back(scan_section(name, scan));
  if (session.boards)
    for (const auto& sensor : session.sensors)
      if (session.boards->shots.count(sensor) && !session.boards->shots.at(sensor).empty())
        sections.push_back(boards_section(sensor, *session.boards));
  return sections;
}

}  // namespace dressform
