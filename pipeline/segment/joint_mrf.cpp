#include <tbb/parallel_for.h>

#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "pipeline/garment/garment_ends.h"
#include "pipeline/garment/garment_kind.h"
#include "pipeline/segment/cloth.h"
#include "pipeline/segment/segment.h"
#include "pipeline/segment/top_bottom.h"
#include "pipeline/segment/view_evidence.h"

namespace dressform {
namespace {

struct JointMrfParams {
  EvidenceParams evidence;
  ClothParams cloth;
  TopBottomParams hem_boundary;
};
template <class V>
void fields(V& v, JointMrfParams& p) {
  v("moved_mm", p.evidence.moved_mm, 1, 100, "mm", "depth change of head and hands beyond which the mannequin moved");
  v("stand_mm", p.evidence.stand_mm, 5, 300, "mm", "unchanged and further from the naked body: the stand");
  v("skin_sigma_mm", p.cloth.skin_sigma_mm, 0.5, 20, "mm", "spread of bare skin about the naked body");
  v("shape_nats", p.cloth.shape_nats, 0, 20, "nats", "most that the offset of one pixel may say about cloth");
  v("change_nats", p.cloth.change_nats, 0, 20, "nats", "most that the colour change of one pixel may say about cloth");
  v("color_nats", p.cloth.color_nats, 0, 20, "nats", "most that the colour of one pixel may say about cloth");
  v("smoothness", p.cloth.smoothness, 0, 100, "nats", "price of an edge between cloth and skin through even colour");
  v("speck_mm2", p.cloth.speck_mm2, 0, 10000, "mm^2", "smaller pieces join what surrounds them");
  v("island_mm2", p.cloth.island_mm2, 0, 50000, "mm^2", "smaller pieces of skin that cloth encloses are print");
  v("raised_mm", p.cloth.raised_mm, 0.5, 100, "mm", "pieces of skin of a larger median offset are cloth of its colour");
  v("cloth_rounds", p.cloth.rounds, 1, 10, "", "rounds of learning the colours of skin and cloth");
  v("hem_boundary_color_nats", p.hem_boundary.color_nats, 0, 20, "nats",
    "most that the colour of one pixel may say about top");
  v("hem_boundary_row_price", p.hem_boundary.row_price, 0.01, 100, "nats",
    "price of 5 mm of change of the hem's height");
  v("hem_boundary_band_mm", p.hem_boundary.band_mm, 5, 300, "mm",
    "band round the hem in which colour decides by pixel");
  v("hem_boundary_smoothness", p.hem_boundary.smoothness, 0, 100, "nats", "price of an edge between top and bottom");
  v("least_mm2", p.hem_boundary.least_mm2, 0, 1e6, "mm^2",
    "cloth on chest or legs below which there is no such garment");
  v("hem_boundary_least_nats", p.hem_boundary.least_nats, 0, 3, "nats", "that colour says for a pixel's side of a hem");
  v("hem_boundary_least_share", p.hem_boundary.least_share, 0.5, 1, "",
    "of the pixels beside a hem that tell their side");
  v("hem_boundary_rounds", p.hem_boundary.rounds, 1, 10, "", "rounds of learning the colours of top and bottom");
}

std::vector<ViewEvidence> gather(const CaptureSession& session, const Calibration& calibration, const NakedBody& body,
                                 const ExtractedViews& extracted, const Registration& registration,
                                 const EvidenceParams& params) {
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
  GarmentLayout layout;
  layout.kind = found.kind;
  layout.sure_kind = found.sure;
  return with_ends(std::move(layout), points, body.query, body.limbs);
}

cv::Size color_size(const CaptureSession& session, const Calibration& calibration, const std::string& sensor) {
  const auto shot = session.dressed.find(sensor);
  if (shot != session.dressed.end() && !shot->second.color.empty()) return shot->second.color.size();
  const auto calibrated = calibration.sensors.find(sensor);
  if (calibrated == calibration.sensors.end() || !calibrated->second.color) return {};
  return {calibrated->second.color->width, calibrated->second.color->height};
}

// Skin, top and bottom in three steps, each joint over the views: evidence of offset and change against the naked
// mannequin; cloth or skin; upper or lower garment.
Segmentation joint_mrf(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                       const ExtractedViews& extracted, const Registration& registration,
                       const JointMrfParams& params) {
  require_known(naked, "segment.joint_mrf");
  const NakedBody body(naked);
  const auto views = gather(session, calibration, body, extracted, registration, params.evidence);
  const auto cloth = find_cloth(views, params.cloth);
  TopBottomParams hem_boundary = params.hem_boundary;
  hem_boundary.speck_mm2 = params.cloth.speck_mm2;
  const TopBottom parted = part_cloth(views, cloth, body.limbs, hem_boundary);

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

const Segment::Variant joint_mrf_variant{"joint_mrf", joint_mrf};

}  // namespace
}  // namespace dressform
