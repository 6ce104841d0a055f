#include <tbb/parallel_for.h>

#include <opencv2/core.hpp>

#include "pipeline/extract/cluster_views.h"
#include "pipeline/extract/naked_stance.h"

namespace dressform {
namespace {

struct ClusterNakedParams {
  ClusterRegionParams region;
  double reach_mm = 150;
  double skirt_reach_mm = 350;
  double band_px = 6;
  double smoothness = 5;
};
template <class V>
void fields(V& v, ClusterNakedParams& p) {
  cluster_region_fields(v, p.region);
  v("reach_mm", p.reach_mm, 20, 1000, "mm", "what is farther outside the naked model is stand or furniture");
  v("skirt_reach_mm", p.skirt_reach_mm, 20, 2000, "mm", "the same between hips and calves, where skirts hang free");
  v("band_px", p.band_px, 1, 40, "px", "how far colour may move the depth's outline, at 1920 x 1080");
  v("smoothness", p.smoothness, 0, 50, "nats", "price of an outline through even colour");
}

constexpr double kHips = 0.52, kCalves = 0.15;  // heights, parts of the stature: of the hip joint, and below the calf

std::vector<Vector3d> points_of(const cv::Mat& points, const cv::Mat& mask) {
  std::vector<Vector3d> result;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask.at<uchar>(y, x)) {
        const auto& p = points.at<cv::Vec3f>(y, x);
        result.emplace_back(p[0], p[1], p[2]);
      }
  return result;
}

void keep_near_model(const cv::Mat& points, const MeshQuery& model, const Isometry3d& model_from_sensor,
                     double stature_m, const ClusterNakedParams& params, cv::Mat& mask) {
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      if (!mask.at<uchar>(y, x)) continue;
      const auto& at = points.at<cv::Vec3f>(y, x);
      const Vector3d p = model_from_sensor * Vector3d(at[0], at[1], at[2]);
      const bool skirt = p.y() > kCalves * stature_m && p.y() < kHips * stature_m;
      const double reach_m = 1e-3 * (skirt ? params.skirt_reach_mm : params.reach_mm);
      if (model.closest(p, reach_m).triangle < 0 && model.signed_distance(p) > 0) mask.at<uchar>(y, x) = 0;
    }
}

// As `cluster`, less what stands far off the naked model: of a stand, what legs do not hide. The model is brought to
// each view's naked shot, else to its dressed one, by closest points (Besl and McKay, PAMI 1992); both shots are cut by
// that pose, for rig and mannequin do not move between them.
ExtractedViews cluster_naked(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                             const ClusterNakedParams& params, Seed seed) {
  auto tasks = view_tasks(session, calibration, naked);
  const MeshQuery model(naked.body);
  const OutlineParams outline{params.band_px, kUnknownBands * params.band_px, params.smoothness};
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t k) {
    std::optional<Isometry3d> pose;
    ClusterSteps steps;
    steps.trim = [&](const cv::Mat& points, const ViewTask& task, BodyRegion& region) {
      if (!pose) pose = model_stance(points_of(points, region.mask), task.expected.up, task.floor, model);
      if (pose) keep_near_model(points, model, *pose, task.expected.stature_m, params, region.mask);
    };
    steps.outline = [&](const cv::Mat& bgr, const cv::Mat& depth_mm, const cv::Mat& mask,
                        const SensorCalibration& sensor, const Background* background) {
      return color_outline(bgr, depth_mm, mask, sensor, outline, background);
    };
    cluster_view(tasks[k], params.region, steps, seed);
  });
  return extracted_views(tasks);
}

const Extract::Variant cluster_naked_variant{"cluster_naked", cluster_naked};

}  // namespace
}  // namespace dressform
