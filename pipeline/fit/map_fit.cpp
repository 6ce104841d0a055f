#include "pipeline/fit/map_fit.h"

#include "pipeline/fit/body_warp.h"
#include "pipeline/fit/cloth_transport.h"
#include "pipeline/fit/fit_result.h"

namespace dressform {

FittedGarments fitted_by_map(const KnownBody& naked_model, const KnownBody& user_model, const TexturedGarments& clothes,
                             const GarmentLayouts& layouts, const std::string& variant, const MakeBodyMap& make) {
  require_bodies(naked_model, user_model, variant);
  const Eigen::Matrix4d motion = user_from_naked(naked_model.landmarks, user_model.landmarks);
  const StandingBody user(user_model);
  const StandingBody naked({transformed(naked_model.body, motion), transformed(naked_model.landmarks, motion)});
  const MeshQuery naked_surface(naked.mesh), user_surface(user.mesh);
  const BodyWarp warp = warp_through(body_pairs(naked, naked_surface, user, user_surface, {}),
                                     [&](const std::vector<Vector3d>& controls, const std::vector<Vector3d>& targets) {
                                       return make(naked.mesh, controls, targets);
                                     });
  ClothTransportParams map_alone;
  map_alone.keep_offset = 0;
  FittedGarments result;
  for (const auto& [name, garment] : clothes.garments) {
    const Mesh turned = transformed(garment.mesh, motion);
    const GarmentLayout& layout = layout_of(name, layouts, variant);
    const Mesh fitted{transported(turned, layout, naked, warp, user_surface, map_alone).vertices, turned.triangles};
    result.foldovers += count_foldovers(turned, fitted);
    add_fitted(name, garment, fitted.vertices, layout, user_model, user_surface, result);
  }
  result.deformed_body = warped_body(naked, warp);
  result.body_rms_m = rms_distance(result.deformed_body, user_surface);
  result.control_points = warp.control_points;
  return result;
}

}  // namespace dressform
