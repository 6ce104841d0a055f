#include "pipeline/imaging/depth_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/imaging/color_mapping.h"

namespace dressform {

std::vector<DepthView> depth_views(const CaptureSession& session, const Calibration& calibration,
                                   const std::map<std::string, Isometry3d>& model_from_sensor) {
  std::vector<DepthView> views;
  for (std::size_t i = 0; i < session.sensors.size(); ++i) {
    const std::string& name = session.sensors[i];
    const auto shot = session.dressed.find(name);
    const auto sensor = calibration.sensors.find(name);
    const auto pose = model_from_sensor.find(name);
    if (shot == session.dressed.end() || sensor == calibration.sensors.end() || pose == model_from_sensor.end() ||
        shot->second.depth_mm.empty())
      continue;
    DepthView view;
    view.index = static_cast<int>(i);
    view.sensor = &sensor->second;
    view.model_from_sensor = pose->second;
    view.sensor_from_model = pose->second.inverse();
    view.depth_mm = corrected_depth_mm(shot->second.depth_mm, sensor->second);
    view.rays = pixel_rays(sensor->second.ir);
    views.push_back(std::move(view));
  }
  return views;
}

double free_space_violation_m(const DepthView& view, const Vector3d& point) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const Vector3d p = view.sensor_from_model * point;
  if (p.z() < 0.1) return nothing;
  const Vector2d pixel = view.sensor->ir.project(p);
  if (!pixel.allFinite()) return nothing;
  const int x = static_cast<int>(std::lround(std::clamp(pixel.x(), -10.0, 1e5)));
  const int y = static_cast<int>(std::lround(std::clamp(pixel.y(), -10.0, 1e5)));
  if (x < 1 || y < 1 || x >= view.depth_mm.cols - 1 || y >= view.depth_mm.rows - 1) return nothing;
  float nearest = std::numeric_limits<float>::infinity();
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const float z = view.depth_mm.at<float>(y + dy, x + dx);
      if (z <= 0) return nothing;
      nearest = std::min(nearest, z);
    }
  return nearest / 1000.0 - p.z();
}

}  // namespace dressform
