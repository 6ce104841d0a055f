#include <tbb/parallel_for.h>

#include <opencv2/core.hpp>

#include "pipeline/extract/body_region.h"
#include "pipeline/extract/color_outline.h"
#include "pipeline/extract/view_task.h"
#include "pipeline/imaging/color_mapping.h"

namespace dressform {
namespace {

struct ClusterParams {
  double jump_mm = 30;
  double radius_m = 0.7;
  ViewFloorParams floor;
  double floor_margin_m = 0.025;
  double band_px = 6;
  double smoothness = 5;
};
template <class V>
void fields(V& v, ClusterParams& p) {
  v("jump_mm", p.jump_mm, 5, 200, "mm", "depth difference of neighbours that parts two pieces");
  v("radius_m", p.radius_m, 0.3, 1.5, "m", "of the upright cylinder that holds body and clothes");
  v("floor_margin_m", p.floor_margin_m, 0.005, 0.2, "m", "what is nearer to the floor than this is floor");
  floor_fields(v, p.floor);
  v("band_px", p.band_px, 1, 40, "px", "how far colour may move the depth's outline, at 1920 x 1080");
  v("smoothness", p.smoothness, 0, 50, "nats", "price of an outline through even colour");
}

constexpr double kUnknownBands = 4;  // bands from the body within which a place without depth may still be the body

// The body on the depth grid; finds the floor on the way.
BodyRegion region_of(const Shot& shot, const cv::Mat& depth_mm, ViewTask& task, const ClusterParams& params,
                     Seed seed) {
  const cv::Mat points = depth_points_m(depth_mm, task.calibration->ir);
  const auto floor = floor_of_view(points, params.floor, task, seed);
  BodyExpectation expected = task.expected;
  if (floor) {
    expected.floor = floor;
    expected.up = floor->head<3>();
  }
  return find_body(depth_mm, points, shot.body_index, expected,
                   {params.jump_mm, params.radius_m, params.floor_margin_m});
}

void run(ViewTask& task, const ClusterParams& params, Seed seed) {
  const OutlineParams outline{params.band_px, kUnknownBands * params.band_px, params.smoothness};
  const bool has_color = task.calibration->color.has_value();
  if (task.naked) {
    const cv::Mat depth = corrected_depth_mm(task.naked->depth_mm, *task.calibration);
    const BodyRegion region = region_of(*task.naked, depth, task, params, seed);
    task.masks.naked = region.mask;
    task.masks.found_naked = region.found;
    if (has_color && !task.naked->color.empty())
      task.masks.naked_color = color_outline(task.naked->color, depth, region.mask, *task.calibration, outline);
  }
  if (task.dressed) {
    const cv::Mat depth = corrected_depth_mm(task.dressed->depth_mm, *task.calibration);
    const BodyRegion region = region_of(*task.dressed, depth, task, params, seed);
    task.masks.dressed = region.mask;
    task.masks.found_dressed = region.found;
    if (!has_color || task.dressed->color.empty()) return;
    const bool reference = task.masks.found_naked && !task.naked->color.empty();
    const Background background{reference ? task.naked->color : cv::Mat(), task.masks.naked_color};
    task.masks.dressed_color = color_outline(task.dressed->color, depth, region.mask, *task.calibration, outline,
                                             reference ? &background : nullptr);
  }
}

// The mannequin as the connected pieces of depth that stand where the rig looks, its outline redrawn in colour by a
// minimum cut (Boykov and Jolly, ICCV 2001; local colour models in the manner of Rother et al., "GrabCut", SIGGRAPH
// 2004).
ExtractedViews cluster(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                       const ClusterParams& params, Seed seed) {
  auto tasks = view_tasks(session, calibration, naked);
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t k) { run(tasks[k], params, seed); });
  return extracted_views(tasks);
}

const Extract::Variant cluster_variant{"cluster", cluster};

}  // namespace
}  // namespace dressform
