#pragma once
#include <functional>

#include "pipeline/extract/body_region.h"
#include "pipeline/extract/color_outline.h"
#include "pipeline/extract/view_task.h"

namespace dressform {

// What the variants that begin with clusters of depth share.
struct ClusterRegionParams {
  double jump_mm = 30;
  double radius_m = 0.7;
  ViewFloorParams floor;
  double floor_margin_m = 0.025;
};
template <class V>
void cluster_region_fields(V& v, ClusterRegionParams& p) {
  v("jump_mm", p.jump_mm, 5, 200, "mm", "depth difference of neighbours that parts two pieces");
  v("radius_m", p.radius_m, 0.3, 1.5, "m", "of the upright cylinder that holds body and clothes");
  v("floor_margin_m", p.floor_margin_m, 0.005, 0.2, "m", "what is nearer to the floor than this is floor");
  floor_fields(v, p.floor);
}

constexpr double kUnknownBands = 4;  // bands from the body within which a place without depth may still be the body

// What a variant does with the pieces that were found.
struct ClusterSteps {
  // Takes from the region (IR grid) what is not the body; points: depth_points_m. Empty: nothing. Called for the naked
  // shot of a view before its dressed one; the floor that the task then holds is the shot's.
  std::function<void(const cv::Mat& points, const ViewTask& task, BodyRegion& region)> trim;
  // The mask at colour size. depth_mm: true depth; mask: the region's; background: as color_outline takes it, or null.
  std::function<cv::Mat(const cv::Mat& bgr, const cv::Mat& depth_mm, const cv::Mat& mask,
                        const SensorCalibration& sensor, const Background* background)>
      outline;
};

// Both shots of one view: the connected pieces of depth that stand where the rig looks, trimmed and outlined. Fills the
// task's masks.
void cluster_view(ViewTask& task, const ClusterRegionParams& params, const ClusterSteps& steps, Seed seed);

}  // namespace dressform
