#include "pipeline/extract/cluster_views.h"

#include <opencv2/core.hpp>

#include "pipeline/imaging/color_mapping.h"

namespace dressform {
namespace {

// The body on the depth grid; finds the floor on the way.
BodyRegion cluster_region(const Shot& shot, const cv::Mat& depth_mm, ViewTask& task, const ClusterRegionParams& params,
                          const ClusterSteps& steps, Seed seed) {
  const cv::Mat points = depth_points_m(depth_mm, task.calibration->ir);
  const auto floor = floor_of_view(points, params.floor, task, seed);
  BodyExpectation expected = task.expected;
  if (floor) {
    expected.floor = floor;
    expected.up = floor->head<3>();
  }
  BodyRegion region =
      find_body(depth_mm, points, shot.body_index, expected, {params.jump_mm, params.radius_m, params.floor_margin_m});
  if (steps.trim && region.found) steps.trim(points, task, region);
  return region;
}

}  // namespace

void cluster_view(ViewTask& task, const ClusterRegionParams& params, const ClusterSteps& steps, Seed seed) {
  const bool has_color = task.calibration->color.has_value();
  if (task.naked) {
    const cv::Mat depth = corrected_depth_mm(task.naked->depth_mm, *task.calibration);
    const BodyRegion region = cluster_region(*task.naked, depth, task, params, steps, seed);
    task.masks.naked = region.mask;
    task.masks.found_naked = region.found;
    if (has_color && !task.naked->color.empty())
      task.masks.naked_color = steps.outline(task.naked->color, depth, region.mask, *task.calibration, nullptr);
  }
  if (task.dressed) {
    const cv::Mat depth = corrected_depth_mm(task.dressed->depth_mm, *task.calibration);
    const BodyRegion region = cluster_region(*task.dressed, depth, task, params, steps, seed);
    task.masks.dressed = region.mask;
    task.masks.found_dressed = region.found;
    if (!has_color || task.dressed->color.empty()) return;
    const bool reference = task.masks.found_naked && !task.naked->color.empty();
    const Background background{reference ? task.naked->color : cv::Mat(), task.masks.naked_color};
    task.masks.dressed_color =
        steps.outline(task.dressed->color, depth, region.mask, *task.calibration, reference ? &background : nullptr);
  }
}

}  // namespace dressform
