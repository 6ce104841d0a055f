// The EON baseline: clothes scaled uniformly by the ratio of the shoulder heights.
#include "pipeline/fit/fit.h"
#include "pipeline/fit/fit_result.h"

namespace dressform {
namespace {

struct UniformParams {};
template <class V>
void fields(V&, UniformParams&) {}

FittedGarments uniform(const KnownBody& naked, const KnownBody& user, const TexturedGarments& clothes,
                       const GarmentLayouts& layouts, const UniformParams&) {
  require_bodies(naked, user, "fit.uniform");
  const Landmarks &from = naked.landmarks, &to = user.landmarks;
  const double scale = (to.armpit_y - to.floor_y) / (from.armpit_y - from.floor_y);
  const Eigen::Matrix4d motion = user_from_naked(from, to, scale);

  const MeshQuery surface(user.body);
  FittedGarments result;
  for (const auto& [name, garment] : clothes.garments)
    add_fitted(name, garment, transformed(garment.mesh, motion).vertices, layout_of(name, layouts, "fit.uniform"), user,
               surface, result);
  result.deformed_body = transformed(naked.body, motion);
  result.body_rms_m = rms_distance(result.deformed_body, surface);
  return result;
}

const Fit::Variant uniform_variant{"uniform", uniform};

}  // namespace
}  // namespace dressform
