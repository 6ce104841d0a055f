#include "pipeline/segment/labelled_views.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "pipeline/garment/garment_ends.h"
#include "pipeline/garment/garment_kind.h"

namespace dressform {
namespace {

cv::Mat label_image(const ViewEvidence& view, const cv::Size& size, const cv::Mat& top, const cv::Mat& bottom) {
  cv::Mat labels = cv::Mat::zeros(size, CV_8U);
  if (view.box.empty()) return labels;
  cv::Mat crop = labels(view.box);
  crop.setTo(static_cast<int>(Label::skin), view.body);
  crop.setTo(static_cast<int>(Label::top), top);
  crop.setTo(static_cast<int>(Label::bottom), bottom);
  return labels;
}

std::vector<Vector3d> places(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& masks) {
  std::vector<Vector3d> points;
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (views[k].box.empty()) continue;
    const cv::Mat seen = masks[k] & views[k].measured;
    for (int v = 0; v < seen.rows; v += 2) {
      for (int u = 0; u < seen.cols; u += 2) {
        if (!seen.at<uchar>(v, u)) continue;
        const auto& p = views[k].place_m.at<cv::Vec3f>(v, u);
        points.emplace_back(p[0], p[1], p[2]);
      }
    }
  }
  return points;
}

GarmentLayout layout_of(const FoundKind& found, const std::vector<Vector3d>& points, const NakedBody& body) {
  return with_ends(with_kind({}, found, body.limbs), points, body.query, body.limbs);
}

cv::Size color_size(const CaptureSession& session, const Calibration& calibration, const std::string& sensor) {
  const auto shot = session.dressed.find(sensor);
  if (shot != session.dressed.end() && !shot->second.color.empty()) return shot->second.color.size();
  const auto calibrated = calibration.sensors.find(sensor);
  if (calibrated == calibration.sensors.end() || !calibrated->second.color) return {};
  return {calibrated->second.color->width, calibrated->second.color->height};
}

}  // namespace

std::vector<ViewEvidence> gather_views(const CaptureSession& session, const Calibration& calibration,
                                       const NakedBody& body, const ExtractedViews& extracted,
                                       const Registration& registration, const EvidenceParams& params) {
  std::vector<ViewEvidence> views(session.sensors.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t k) {
    const std::string& sensor = session.sensors[k];
    const auto shot = session.dressed.find(sensor), naked = session.naked.find(sensor);
    const auto masks = extracted.views.find(sensor);
    const auto pose = registration.model_from_sensor.find(sensor);
    const auto calibrated = calibration.sensors.find(sensor);
    if (shot == session.dressed.end() || masks == extracted.views.end() || calibrated == calibration.sensors.end() ||
        pose == registration.model_from_sensor.end() || !masks->second.found_dressed)
      return;
    views[k] = view_evidence(shot->second, naked == session.naked.end() ? nullptr : &naked->second, calibrated->second,
                             masks->second, pose->second, body, params);
  });
  return views;
}

Segmentation labelled_views(const CaptureSession& session, const Calibration& calibration, const NakedBody& body,
                            const std::vector<ViewEvidence>& views, const TopBottom& parted) {
  Segmentation result;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const std::string& sensor = session.sensors[k];
    result.labels[sensor] =
        label_image(views[k], color_size(session, calibration, sensor), parted.top[k], parted.bottom[k]);
  }
  if (parted.has_top) {
    const auto points = places(views, parted.top);
    const FoundKind one = parted.has_bottom ? FoundKind{"shirt", 1} : top_kind(points, body.limbs);
    result.garments["top"] = layout_of(one, points, body);
  }
  if (parted.has_bottom) {
    const auto points = places(views, parted.bottom);
    result.garments["bottom"] = layout_of(bottom_kind(points, body.limbs), points, body);
  }
  return result;
}

}  // namespace dressform
