// Truncated signed distances from the views' depth: Curless and Levoy, "A volumetric method for building complex models
// from range images", SIGGRAPH 1996, with the depth smoothed as in Newcombe et al., "KinectFusion", ISMAR 2011. What
// volumetric fusion makes of four views that stand still. Open3D's integration knows no lens distortion, and closes no
// holes; the paper's space carving does.
#include <string>

#include "pipeline/geometry/ball_mesh.h"
#include "pipeline/surface/closed_cloth.h"
#include "pipeline/surface/truncated_distances.h"

namespace dressform {
namespace {

struct TsdfParams {
  GarmentCloudParams cloud = as_measured();
  TruncationParams volume;
  int normal_neighbours = 20;
  double voxel_m = 0.006;
  int fewest_points = 300;
};
template <class V>
void fields(V& v, TsdfParams& p) {
  fields(v, p.cloud);
  v("normal_neighbours", p.normal_neighbours, 4, 200, "", "nearest points whose principal components give a normal");
  v("truncation_m", p.volume.truncation_m, 0.005, 0.1, "m", "distances beyond this count as this");
  v("range_mm", p.volume.range_mm, 0.0, 100.0, "mm", "of the depth images' bilateral filter, in depth; 0: none");
  v("space_px", p.volume.space_px, 0.0, 10.0, "px", "of the depth images' bilateral filter, in the image");
  v("voxel_m", p.voxel_m, 0.003, 0.03, "m", "edge of one voxel");
  v("fewest_points", p.fewest_points, 50, 100000, "", "a garment with fewer points is left out");
}

Mesh fused_views(const ClothTask& task, const CaptureSession& session, const FilledViews& filled,
                 const TsdfParams& params) {
  TruncationParams volume = params.volume;
  volume.see_through_m = params.cloud.see_through_m;
  volume.jump_mm = params.cloud.jump_mm;
  std::vector<ClothDepth> cloth;
  const auto& views_of_garment = filled.garments.at(task.name);
  for (const DepthView& view : task.views) {
    const auto found = views_of_garment.find(session.sensors[static_cast<std::size_t>(view.index)]);
    if (found == views_of_garment.end() || found->second.depth_mm.size() != view.depth_mm.size()) continue;
    cloth.push_back(cloth_depth(view, found->second.depth_mm, volume));
  }
  const Lattice lattice = lattice_round(Mesh{task.support.points, {}}, params.voxel_m);
  return closed_level_set(task, lattice, truncated_distances(lattice, cloth, volume), params.cloud.see_through_m);
}

ClosedGarments tsdf(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                    const Registration& registration, const FilledViews& filled, const GarmentLayouts& segmented,
                    const TsdfParams& params) {
  return closed_cloths(session, calibration, naked, registration, filled, segmented, params.cloud,
                       params.normal_neighbours, params.fewest_points, "surface.tsdf",
                       [&](const ClothTask& task) { return fused_views(task, session, filled, params); });
}

const Surface::Variant tsdf_variant{"tsdf", tsdf};

}  // namespace
}  // namespace dressform
