#include "eval/inspect/session_points.h"

#include <algorithm>
#include <cmath>

#include "eval/inspect/session_cameras.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

using Eigen::Vector3f;

Vector3f sensor_color(std::size_t sensor) {
  static const Vector3f colors[] = {{0.84f, 0.37f, 0.00f}, {0.00f, 0.45f, 0.70f}, {0.00f, 0.62f, 0.45f},
                                    {0.90f, 0.62f, 0.00f}, {0.80f, 0.47f, 0.65f}, {0.34f, 0.71f, 0.91f},
                                    {0.55f, 0.27f, 0.07f}, {0.35f, 0.35f, 0.35f}};
  return colors[sensor % 8];
}

// Colour of a point seen by the colour camera, else the infrared's grey.
Vector3f seen_color(const SensorCalibration& sensor, const Shot& shot, const Vector3d& point_in_ir, int x, int y,
                    double brightest) {
  if (sensor.color && !shot.color.empty()) {
    const Vector3d point = sensor.color_from_ir * point_in_ir;
    const Vector2d pixel = point.z() > 0 ? sensor.color->project(point) : Vector2d(-1, -1);
    if (sensor.color->contains(pixel)) {
      const auto bgr =
          shot.color.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
      return Vector3f(bgr[2], bgr[1], bgr[0]) / 255;
    }
  }
  if (shot.ir.empty()) return Vector3f::Constant(0.5f);
  return Vector3f::Constant(static_cast<float>(std::min(1.0, shot.ir.at<std::uint16_t>(y, x) / brightest)));
}

double brightest_of(const cv::Mat& ir) {
  if (ir.empty()) return 1;
  std::vector<std::uint16_t> values(ir.begin<std::uint16_t>(), ir.end<std::uint16_t>());
  const std::size_t place = values.size() * 98 / 100;
  return std::max<double>(1, nth_value(std::move(values), place));
}

// Points of a shot in the frame of `frame_from_sensor`; one cloud in `plain`, another in the colours seen.
void add_points(const SensorCalibration& sensor, const Shot& shot, const Isometry3d& frame_from_sensor,
                const Vector3f& plain, PointCloud& by_sensor, PointCloud& as_seen) {
  const double brightest = brightest_of(shot.ir);
  for (int y = 0; y < shot.depth_mm.rows; y += 2)
    for (int x = 0; x < shot.depth_mm.cols; x += 2) {
      const double z = 0.001 * shot.depth_mm.at<std::uint16_t>(y, x) - sensor.depth_offset_m;
      if (shot.depth_mm.at<std::uint16_t>(y, x) == 0 || z <= 0) continue;
      const Vector3d point = sensor.ir.unproject({static_cast<double>(x), static_cast<double>(y)}, z);
      by_sensor.points.push_back(frame_from_sensor * point);
      by_sensor.colors.push_back(plain);
      as_seen.points.push_back(by_sensor.points.back());
      as_seen.colors.push_back(seen_color(sensor, shot, point, x, y, brightest));
    }
}

// The four sides of what a sensor sees up to 0.35 m before it.
Mesh frustum(const Camera& camera, const Isometry3d& frame_from_sensor) {
  Mesh mesh;
  mesh.vertices.push_back(frame_from_sensor.translation());
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    mesh.vertices.push_back(frame_from_sensor *
                            camera.unproject({x * (camera.width - 1.0), y * (camera.height - 1.0)}, 0.35));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  return mesh;
}

// The points in the middle of the rig, where the mannequin stands.
PointCloud middle_of(const PointCloud& cloud) {
  PointCloud result;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vector3d& point = cloud.points[i];
    if (std::hypot(point.x(), point.z()) > 0.8 || point.y() > 2.3) continue;
    result.points.push_back(point);
    result.colors.push_back(cloud.colors[i]);
  }
  return result;
}

// Without the farthest fiftieth on every side, which stray points would fill the image with.
Eigen::AlignedBox3d box_of(const PointCloud& cloud, const std::vector<Mesh>& frusta) {
  Eigen::AlignedBox3d box;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& point : cloud.points) values.push_back(point[axis]);
    std::sort(values.begin(), values.end());
    box.min()[axis] = values[values.size() / 50];
    box.max()[axis] = values[values.size() - 1 - values.size() / 50];
  }
  for (const auto& each : frusta)
    for (const auto& vertex : each.vertices) box.extend(vertex);
  box.min().array() -= 0.05;  // a lone point is no box
  box.max().array() += 0.05;
  return box;
}

std::vector<RenderItem> items_of(const PointCloud& cloud, const std::vector<Mesh>& frusta, bool colored) {
  std::vector<RenderItem> items(1 + frusta.size());
  items[0].points = &cloud;
  items[0].shading = Shading::points;
  for (std::size_t i = 0; i < frusta.size(); ++i) {
    items[i + 1].mesh = &frusta[i];
    items[i + 1].shading = Shading::wireframe;
    items[i + 1].color = colored ? sensor_color(i) : Vector3f(0.2f, 0.2f, 0.2f);
  }
  return items;
}

cv::Mat from_sides(Renderer& renderer, const PointCloud& cloud, const std::vector<Mesh>& frusta, bool colored,
                   const std::vector<std::pair<double, double>>& directions_deg, int width, int height) {
  const Eigen::AlignedBox3d box = box_of(cloud, frusta);
  std::vector<RenderView> views;
  for (const auto& [azimuth, elevation] : directions_deg)
    views.push_back(look_at_box(box.min(), box.max(), azimuth, elevation, width, height));
  return side_by_side(renderer.render(views, items_of(cloud, frusta, colored)), height);
}

// The shot that a sensor's points are taken from: dressed, naked, or of its first board; nothing without one.
const Shot* shot_of(const CaptureSession& session, const std::string& sensor, Shot& board) {
  for (const auto* shots : {&session.dressed, &session.naked})
    if (const auto found = shots->find(sensor); found != shots->end()) return &found->second;
  if (!session.boards) return nullptr;
  const auto found = session.boards->shots.find(sensor);
  if (found == session.boards->shots.end() || found->second.empty()) return nullptr;
  board.depth_mm = found->second.front().depth_mm;
  board.ir = found->second.front().ir;
  return &board;
}

InspectionSection in_the_rig(const CaptureSession& session, Renderer& renderer) {
  InspectionSection section{"Points in the rig", {}, {}, {}, {}};
  PointCloud by_sensor, as_seen;
  std::vector<Mesh> frusta;
  Shot board;
  for (std::size_t i = 0; i < session.sensors.size(); ++i) {
    const auto pose = session.prior->world_from_sensor.find(session.sensors[i]);
    const Shot* shot = shot_of(session, session.sensors[i], board);
    if (!shot || pose == session.prior->world_from_sensor.end()) continue;
    const auto sensor = inspected_sensor(session, session.sensors[i], shot->depth_mm.size());
    add_points(sensor.calibration, *shot, pose->second, sensor_color(i), by_sensor, as_seen);
    frusta.push_back(frustum(sensor.calibration.ir, pose->second));
  }
  if (by_sensor.points.empty()) return section;
  section.text.push_back("Each sensor where the rig's prior puts it: rough, by a few degrees and centimetres.");
  section.figures.push_back({"points_by_sensor", "One colour a sensor",
                             "From the front and above, and from straight above.",
                             from_sides(renderer, by_sensor, frusta, true, {{25, 30}, {0, 89}}, 760, 620)});
  section.figures.push_back({"points_as_seen", "In the colours seen",
                             "From the front and from the back; grey: where no colour camera looks.",
                             from_sides(renderer, as_seen, frusta, false, {{20, 25}, {200, 25}}, 760, 620)});
  if (const PointCloud middle = middle_of(by_sensor); !middle.points.empty())
    section.figures.push_back(
        {"points_middle", "The middle of the rig", "One colour a sensor: front, left, back, right.",
         from_sides(renderer, middle, {}, true, {{0, 5}, {90, 5}, {180, 5}, {270, 5}}, 380, 620)});
  return section;
}

InspectionSection one_by_one(const CaptureSession& session, Renderer& renderer) {
  InspectionSection section{"Points of the sensors", {}, {}, {}, {}};
  Isometry3d upright = Isometry3d::Identity();  // y up, looking along -z
  upright.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
  Shot other;
  const auto add = [&](const std::string& name, const std::string& sensor, const Shot& shot) {
    PointCloud plain, seen;
    const auto inspected = inspected_sensor(session, sensor, shot.depth_mm.size());
    add_points(inspected.calibration, shot, upright, sensor_color(0), plain, seen);
    if (seen.points.empty()) return;
    section.figures.push_back({"points_" + name, name,
                               std::string("From the sensor's side, from the left and from above.") +
                                   (inspected.nominal ? " Not calibrated: the usual camera of this image size." : ""),
                               from_sides(renderer, seen, {}, false, {{0, 0}, {-50, 10}, {0, 70}}, 520, 460)});
  };
  for (const auto& sensor : session.sensors)
    if (const Shot* shot = shot_of(session, sensor, other)) add(sensor, sensor, *shot);
  for (const auto& [name, scan] : session.scans) {
    other = Shot{};
    other.depth_mm = scan.depth_mm.front();
    add(name, scan.sensor, other);
  }
  if (!section.figures.empty()) section.text.push_back("The session has no rig prior: each sensor by itself.");
  return section;
}

}  // namespace

InspectionSection points_section(const CaptureSession& session, Renderer& renderer) {
  if (session.prior) {
    InspectionSection section = in_the_rig(session, renderer);
    if (!section.figures.empty()) return section;
  }
  return one_by_one(session, renderer);
}

}  // namespace dressform
