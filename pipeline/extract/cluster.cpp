#include <tbb/parallel_for.h>

#include <opencv2/core.hpp>

#include "pipeline/extract/cluster_views.h"

namespace dressform {
namespace {

struct ClusterParams {
  ClusterRegionParams region;
  double band_px = 6;
  double smoothness = 5;
};
template <class V>
void fields(V& v, ClusterParams& p) {
  cluster_region_fields(v, p.region);
  v("band_px", p.band_px, 1, 40, "px", "how far colour may move the depth's outline, at 1920 x 1080");
  v("smoothness", p.smoothness, 0, 50, "nats", "price of an outline through even colour");
}

// The mannequin as the connected pieces of depth that stand where the rig looks, its outline redrawn in colour by a
// minimum cut (Boykov and Jolly, ICCV 2001; local colour models in the manner of Rother et al., "GrabCut", SIGGRAPH
// 2004).
ExtractedViews cluster(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                       const ClusterParams& params, Seed seed) {
  auto tasks = view_tasks(session, calibration, naked);
  ClusterSteps steps;
  steps.outline = [outline = OutlineParams{params.band_px, kUnknownBands * params.band_px, params.smoothness}](
                      const cv::Mat& bgr, const cv::Mat& depth_mm, const cv::Mat& mask, const SensorCalibration& sensor,
                      const Background* background) {
    return color_outline(bgr, depth_mm, mask, sensor, outline, background);
  };
  tbb::parallel_for(std::size_t{0}, tasks.size(),
                    [&](std::size_t k) { cluster_view(tasks[k], params.region, steps, seed); });
  return extracted_views(tasks);
}

const Extract::Variant cluster_variant{"cluster", cluster};

}  // namespace
}  // namespace dressform
