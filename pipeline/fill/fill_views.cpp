#include "pipeline/fill/fill_views.h"

#include <tbb/parallel_for.h>

#include <functional>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "pipeline/body/body_landmarks.h"

namespace dressform {
namespace {

PartedBody parted(const KnownBody& naked) {
  const Mesh& body = naked.body;
  Mesh trunk{body.vertices, {}}, arms{body.vertices, {}};
  for (std::size_t k = 0; k < body.triangles.size(); ++k) {
    (is_arm(naked.landmarks.triangle_parts[k]) ? arms : trunk).triangles.push_back(body.triangles[k]);
  }
  return {MeshQuery(trunk), MeshQuery(arms)};
}

FilledGarment nothing(const cv::Size& color, const cv::Size& ir) {
  return {cv::Mat::zeros(color, CV_8UC3), cv::Mat::zeros(color, CV_8U), cv::Mat::zeros(ir, CV_32F),
          cv::Mat::zeros(ir, CV_8U)};
}

const char* slot_of(Label label) { return label == Label::top ? "top" : "bottom"; }

// What is seen of a garment in a view, and how to find what something in front hides of it: that costs a membrane.
struct CertainDepth {
  cv::Mat seen_mm;
  std::function<cv::Mat()> hidden_mm;
};

void take_depth(const cv::Mat& seen_mm, const cv::Mat& hidden_mm, GarmentView& view) {
  view.garment.synthetic = hidden_mm > 0;
  view.garment.depth_mm = seen_mm + hidden_mm;
  view.map = color_depth_map(view.garment.depth_mm, view.calibration);
}

// The hole is where the person says, but for what is seen of the garment; what was found hidden counts within it alone.
void take_picked_hole(const CertainDepth& depth, const PickedHoles& picked, GarmentView& view) {
  const cv::Mat region = picked.region(slot_of(view.label), view.sensor);
  cv::Mat hidden = cv::Mat::zeros(depth.seen_mm.size(), CV_32F);
  if (!region.empty() && picked.depth) {
    const cv::Mat found = depth.hidden_mm(), whole = depth.seen_mm + found;
    found.copyTo(hidden, to_depth(region, color_of_depth_pixels(whole, view.calibration)));
  }
  take_depth(depth.seen_mm, hidden, view);
  if (!region.empty()) view.garment.mask.setTo(128, region & (view.garment.mask == 0));
}

void take_found_hole(const CertainDepth& depth, GarmentView& view) {
  take_depth(depth.seen_mm, depth.hidden_mm(), view);
  const cv::Mat filled = to_color(view.garment.synthetic, view.map);
  view.garment.mask.setTo(128, filled & (view.garment.mask == 0) & (view.labels > 0));
}

GarmentView garment_view(const Shot& dressed, const LabelledShot& shot, GarmentView view, const PartedBody& body,
                         const HoleParams& holes, const PickedHoles* picked) {
  const cv::Mat seen = garment_depth(shot, view.label);
  const CertainDepth depth{
      seen,
      [&] { return hidden_depth(shot, view.label, seen, view.calibration.ir, view.model_from_sensor, body, holes); }};
  view.garment.color = dressed.color.clone();
  view.garment.mask = view.labels == static_cast<int>(view.label);
  if (picked)
    take_picked_hole(depth, *picked, view);
  else
    take_found_hole(depth, view);
  return view;
}

std::vector<Label> worn(const Segmentation& segmentation) {
  std::vector<Label> labels;
  if (segmentation.garments.count("top")) labels.push_back(Label::top);
  if (segmentation.garments.count("bottom")) labels.push_back(Label::bottom);
  return labels;
}

bool usable(const CaptureSession& session, const Registration& registration, const Segmentation& segmentation,
            const SensorCalibration& calibration, const std::string& sensor) {
  const auto shot = session.dressed.find(sensor);
  const auto labels = segmentation.labels.find(sensor);
  return shot != session.dressed.end() && labels != segmentation.labels.end() && calibration.color &&
         registration.model_from_sensor.count(sensor) && !shot->second.color.empty() &&
         shot->second.color.size() == labels->second.size();
}

}  // namespace

FilledViews fill_views(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                       const Registration& registration, const Segmentation& segmentation,
                       const GarmentDepthParams& depth, const HoleParams& holes, const ColorFill& color,
                       const PickedHoles* picked) {
  require_known(naked, "fill");
  const auto labels = worn(segmentation);
  const std::size_t sensors = session.sensors.size();
  const PartedBody body = parted(naked);
  std::vector<std::vector<GarmentView>> views(labels.size(), std::vector<GarmentView>(sensors));
  tbb::parallel_for(std::size_t{0}, sensors, [&](std::size_t k) {
    const std::string& sensor = session.sensors[k];
    const SensorCalibration& calibrated = calibration.sensors.at(sensor);
    const bool use = usable(session, registration, segmentation, calibrated, sensor);
    LabelledShot shot;
    if (use) shot = labelled_shot(session.dressed.at(sensor), calibrated, segmentation.labels.at(sensor), depth);
    for (std::size_t g = 0; g < labels.size(); ++g) {
      GarmentView& view = views[g][k];
      view.sensor = sensor;
      view.label = labels[g];
      view.calibration = calibrated;
      const Camera from = calibrated.color.value_or(Camera{});
      view.garment = nothing({from.width, from.height}, {calibrated.ir.width, calibrated.ir.height});
      if (!use) continue;
      view.labels = segmentation.labels.at(sensor);
      view.model_from_sensor = registration.model_from_sensor.at(sensor);
      view = garment_view(session.dressed.at(sensor), shot, view, body, holes, picked);
    }
  });

  FilledViews result;
  for (std::size_t g = 0; g < labels.size(); ++g) {
    std::vector<cv::Mat> painted(sensors);
    tbb::parallel_for(std::size_t{0}, sensors, [&](std::size_t k) {
      if (cv::countNonZero(views[g][k].garment.mask == 128) > 0) painted[k] = color(views[g], k);
    });
    auto& garment = result.garments[slot_of(labels[g])];
    for (std::size_t k = 0; k < sensors; ++k) {
      FilledGarment filled = views[g][k].garment;
      if (!painted[k].empty()) painted[k].copyTo(filled.color, filled.mask == 128);
      garment[session.sensors[k]] = filled;
    }
  }
  return result;
}

}  // namespace dressform
