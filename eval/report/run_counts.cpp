#include "eval/report/run_counts.h"

#include <cmath>
#include <opencv2/core.hpp>

namespace dressform {
namespace {

MeshCounts counts_of(const Mesh& mesh) {
  const Topology shape = topology(mesh);
  return {shape.vertices, shape.triangles, shape.boundary_edges};
}

long long pixels(const cv::Mat& mask) { return mask.empty() ? 0 : cv::countNonZero(mask); }

GarmentCounts garment_counts(const Reconstruction& made, const std::string& slot) {
  GarmentCounts counts;
  const auto& poses = made.registration.get().model_from_sensor;
  long long points = 0;
  for (const auto& [sensor, view] : made.filled.get().garments.at(slot)) {
    counts.pixels[sensor] = {pixels(view.mask == 255), pixels(view.mask == 128)};
    if (poses.count(sensor)) points += pixels(view.depth_mm > 0);
  }
  counts.points = points;
  const auto& closed = made.closed.get().garments;
  if (const auto found = closed.find(slot); found != closed.end()) {
    counts.cleaned = static_cast<long long>(found->second.support.points.size());
    counts.closed = counts_of(found->second.mesh);
  } else {
    counts.not_closed = "surface made none of it";
  }
  const OpenGarments& opened = made.opened.get();
  if (const auto found = opened.garments.find(slot); found != opened.garments.end())
    counts.open = counts_of(found->second.mesh);
  else if (const auto why = opened.failed.find(slot); why != opened.failed.end())
    counts.not_open = why->second;
  else
    counts.not_open = "there was no closed surface to open";
  return counts;
}

}  // namespace

std::string view_of(const Landmarks& body, const Vector3d& sensor_in_model) {
  const Vector3d out = sensor_in_model - body.axis;
  const double front = out.dot(body.front), left = out.dot(body.left);
  if (std::abs(front) >= std::abs(left)) return front > 0 ? "Front" : "Back";
  return left > 0 ? "Left" : "Right";
}

RunCounts counts_of(const Reconstruction& made, const std::string& run, const std::string& scene, double scale) {
  RunCounts counts;
  counts.run = run;
  counts.scene = scene;
  counts.scale = scale;
  counts.sensors = made.sensors;
  counts.calibration = made.calibration.get();
  const Registration& registration = made.registration.get();
  counts.model_from_sensor = registration.model_from_sensor;
  counts.not_registered = registration.problem;
  for (const std::string& sensor : made.sensors) {
    const auto pose = registration.model_from_sensor.find(sensor);
    if (pose != registration.model_from_sensor.end())
      counts.view[sensor] = view_of(made.landmarks.get(), pose->second.translation());
    const auto camera = counts.calibration.sensors.find(sensor);
    if (camera == counts.calibration.sensors.end() || !camera->second.color) continue;
    counts.image[sensor] = static_cast<long long>(camera->second.color->width) * camera->second.color->height;
    const auto masks = made.extracted.get().views.find(sensor);
    if (masks != made.extracted.get().views.end() && masks->second.found_dressed)
      counts.mannequin[sensor] = pixels(masks->second.dressed_color);
  }
  for (const auto& [slot, views] : made.filled.get().garments) counts.garments[slot] = garment_counts(made, slot);
  return counts;
}

}  // namespace dressform
