#include <tbb/parallel_for.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "pipeline/extract/cluster_views.h"
#include "pipeline/imaging/color_mapping.h"
#include "pipeline/imaging/seeded_rng.h"

namespace dressform {
namespace {

struct GrabcutParams {
  ClusterRegionParams region;
  double band_px = 6;
  int iterations = 5;
};
template <class V>
void fields(V& v, GrabcutParams& p) {
  cluster_region_fields(v, p.region);
  v("band_px", p.band_px, 1, 40, "px",
    "to either side of the depth's outline, in which colour decides, at 1920 x 1080");
  v("iterations", p.iterations, 1, 20, "", "of learning the colours and cutting");
}

constexpr int kLeastSure = 50;  // pixels of either side, that a mixture of five Gaussians is learnt from

cv::Mat grabcut_window(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radius + 1, 2 * radius + 1));
}

// The depth's mask at colour size and its surroundings as grabCut wants them told: sure beyond the band, a guess in it.
cv::Mat told_by_depth(const cv::Mat& body, int band) {
  cv::Mat inner, outer, told(body.size(), CV_8U, cv::Scalar(cv::GC_BGD));
  cv::erode(body, inner, grabcut_window(band));
  cv::dilate(body, outer, grabcut_window(band));
  told.setTo(cv::GC_PR_BGD, outer);
  told.setTo(cv::GC_PR_FGD, body);
  told.setTo(cv::GC_FGD, inner);
  return told;
}

cv::Mat grabcut_outline(const cv::Mat& bgr, const cv::Mat& depth_mm, const cv::Mat& mask,
                        const SensorCalibration& sensor, const GrabcutParams& params, Seed seed) {
  cv::Mat result = cv::Mat::zeros(bgr.size(), CV_8U);
  cv::Mat body = to_color(mask, color_depth_map(depth_mm, sensor));
  if (cv::countNonZero(body) == 0) return result;
  const int band = std::max(2, cvRound(params.band_px * sensor.color->width / 1920.0));
  // A depth pixel is as wide as three colour pixels: gaps between them are no outline.
  cv::morphologyEx(body, body, cv::MORPH_CLOSE, grabcut_window(std::max(1, band / 2)));
  const cv::Rect tight = cv::boundingRect(body);
  const int margin = static_cast<int>(3 * kUnknownBands) * band;  // as much of the room as color_outline learns from
  const cv::Rect box =
      cv::Rect(tight.x - margin, tight.y - margin, tight.width + 2 * margin, tight.height + 2 * margin) &
      cv::Rect({0, 0}, bgr.size());
  cv::Mat told = told_by_depth(body(box), band), background, foreground;
  const cv::Mat image = bgr(box).clone();
  if (cv::countNonZero(told == cv::GC_FGD) >= kLeastSure && cv::countNonZero(told == cv::GC_BGD) >= kLeastSure) {
    const SeededRng seeded(seed);
    cv::grabCut(image, told, {}, background, foreground, params.iterations, cv::GC_INIT_WITH_MASK);
  }
  cv::Mat cut = (told == cv::GC_FGD) | (told == cv::GC_PR_FGD);
  cut.copyTo(result(box));
  return result;
}

// The mannequin as the connected pieces of depth that stand where the rig looks, its outline redrawn by OpenCV's
// grabCut on a band about that of the depth: what one does first with the library (Rother, Kolmogorov and Blake,
// "GrabCut": interactive foreground extraction using iterated graph cuts, SIGGRAPH 2004). One mixture of colours for
// the whole body and one for all that surrounds it.
ExtractedViews cluster_grabcut(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                               const GrabcutParams& params, Seed seed) {
  auto tasks = view_tasks(session, calibration, naked);
  ClusterSteps steps;
  steps.outline = [&](const cv::Mat& bgr, const cv::Mat& depth_mm, const cv::Mat& mask, const SensorCalibration& sensor,
                      const Background*) { return grabcut_outline(bgr, depth_mm, mask, sensor, params, seed); };
  tbb::parallel_for(std::size_t{0}, tasks.size(),
                    [&](std::size_t k) { cluster_view(tasks[k], params.region, steps, seed); });
  return extracted_views(tasks);
}

const Extract::Variant cluster_grabcut_variant{"cluster_grabcut", cluster_grabcut};

}  // namespace
}  // namespace dressform
