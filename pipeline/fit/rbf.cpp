// Clothes resized by radial basis functions between the naked mannequin and the user (section 3.6 of the thesis), with
// control points found on both bodies by the program, and the offset of cloth from body kept.
#include <algorithm>
#include <cmath>

#include "pipeline/body/standing_body.h"
#include "pipeline/fit/body_warp.h"
#include "pipeline/fit/cloth_transport.h"
#include "pipeline/fit/ease.h"
#include "pipeline/fit/fit.h"
#include "pipeline/fit/fit_result.h"
#include "pipeline/fit/limbs_apart.h"

namespace dressform {
namespace {

constexpr double kBetweenLimbs_m = 0.001;  // of cloth from the surface midway between two parts of the user's body

constexpr double kEaseStep_m = 0.01;  // of radius a round, at most

struct RbfParams {
  std::string kernel = "r";
  double smoothing_m = 0.02;
  double radius_m = 0.3;
  int rounds = 2;
  double snap_spacing_m = 0.06;
  double keep_offset = 1;
  int ease_rounds = 4;
};
template <class V>
void fields(V& v, RbfParams& p) {
  v("kernel", p.kernel, {"r", "r3", "gaussian", "wendland"}, "radial basis function beside the affine part");
  v("smoothing_m", p.smoothing_m, 0.0, 1.0, "m",
    "how much the map may miss its targets for smoothness; of kernels that fall off, a part of their height");
  v("radius_m", p.radius_m, 0.02, 5.0, "m", "where a Gaussian has fallen to 1/e, and Wendland's function ends");
  v("rounds", p.rounds, 0, 5, "", "of snapping the warped body to the user's surface");
  v("snap_spacing_m", p.snap_spacing_m, 0.03, 0.2, "m", "between the body's points that are snapped");
  v("keep_offset", p.keep_offset, 0.0, 1.0, "",
    "0: the map alone moves the cloth; 1: cloth keeps its distance from the body");
  v("ease_rounds", p.ease_rounds, 0, 10, "", "of measuring girths round the trunk and moving cloth to keep the ease");
}

RbfField::Kernel kernel_named(const std::string& name) {
  if (name == "gaussian") return RbfField::Kernel::gaussian;
  if (name == "wendland") return RbfField::Kernel::wendland;
  return name == "r" ? RbfField::Kernel::linear : RbfField::Kernel::cubic;
}

BodyWarpParams warp_params(const RbfParams& params) {
  BodyWarpParams result;
  result.kernel = kernel_named(params.kernel);
  result.smoothing = params.smoothing_m;
  result.radius_m = params.radius_m;
  result.rounds = params.rounds;
  result.snap_spacing_m = params.snap_spacing_m;
  return result;
}

Mesh fitted_mesh(const Mesh& garment, const GarmentLayout& layout, const StandingBody& naked, const BodyWarp& warp,
                 const StandingBody& user, const MeshQuery& user_surface, const RbfParams& params) {
  ClothTransportParams transport;
  transport.keep_offset = params.keep_offset;
  const Transported moved = transported(garment, layout, naked, warp, user_surface, transport);
  Mesh result{moved.vertices, garment.triangles};
  std::vector<double> trunk(moved.sleeve.size());
  for (std::size_t v = 0; v < trunk.size(); ++v) trunk[v] = 1 - moved.sleeve[v];
  // Before the ease is measured, so that no sleeve stands in the trunk's cloth; and after it was given back.
  const ClothLimbs limbs = limbs_of_cloth(garment, layout, naked);
  result.vertices = limbs_kept_apart(result, limbs, user, user_surface, kBetweenLimbs_m);
  result.vertices = with_ease_kept(garment, naked, result, user, trunk, kEaseStep_m, params.ease_rounds);
  result.vertices = limbs_kept_apart(result, limbs, user, user_surface, kBetweenLimbs_m);
  return result;
}

FittedGarments rbf(const KnownBody& naked_model, const KnownBody& user_model, const TexturedGarments& clothes,
                   const GarmentLayouts& layouts, const RbfParams& params) {
  require_bodies(naked_model, user_model, "fit.rbf");
  const Eigen::Matrix4d motion = user_from_naked(naked_model.landmarks, user_model.landmarks);
  const StandingBody user(user_model);
  const StandingBody naked({transformed(naked_model.body, motion), transformed(naked_model.landmarks, motion)});

  const MeshQuery naked_surface(naked.mesh), user_surface(user.mesh);
  const BodyWarp warp = warp_body(naked, naked_surface, user, user_surface, warp_params(params));

  FittedGarments result;
  for (const auto& [name, garment] : clothes.garments) {
    const Mesh turned = transformed(garment.mesh, motion);
    const GarmentLayout& layout = layout_of(name, layouts, "fit.rbf");
    const Mesh fitted = fitted_mesh(turned, layout, naked, warp, user, user_surface, params);
    result.foldovers += count_foldovers(turned, fitted);
    add_fitted(name, garment, fitted.vertices, layout, user_model, user_surface, result);
  }
  result.deformed_body = warped_body(naked, warp);
  result.body_rms_m = rms_distance(result.deformed_body, user_surface);
  result.control_points = warp.control_points;
  return result;
}

const Fit::Variant rbf_variant{"rbf", rbf};

}  // namespace
}  // namespace dressform
