// The EON baseline: clothes scaled uniformly by the ratio of the shoulder heights.
#include "pipeline/fit/fit.h"
#include "pipeline/fit/fit_result.h"
#include "pipeline/fit/standing_body.h"

namespace dressform {
namespace {

struct UniformParams {};
template <class V>
void fields(V&, UniformParams&) {}

FittedGarments uniform(const BodyModel& naked_model, const BodyModel& user_model, const TexturedGarments& clothes,
                       const UniformParams&) {
  require_bodies(naked_model, user_model, "fit.uniform");
  const StandingBody naked = analyse_body(naked_model.body);
  const StandingBody user = face_alike(naked, user_model.body).user;
  const double scale = (user.armpit_y - user.limbs.floor_y) / (naked.armpit_y - naked.limbs.floor_y);
  const Eigen::Vector3d up = Vector3d::UnitY();
  Eigen::Matrix3d naked_axes, user_axes;
  naked_axes << naked.limbs.left, up, naked.limbs.front;
  user_axes << user.limbs.left, up, user.limbs.front;
  Vector3d naked_origin = naked.axis, user_origin = user.axis;
  naked_origin.y() = naked.limbs.floor_y;
  user_origin.y() = user.limbs.floor_y;
  Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();
  motion.topLeftCorner<3, 3>() = scale * user_axes * naked_axes.transpose();
  motion.topRightCorner<3, 1>() = user_origin - motion.topLeftCorner<3, 3>() * naked_origin;

  FittedGarments result;
  for (const auto& [name, garment] : clothes.garments)
    result.garments[name] = with_vertices(garment, transformed(garment.mesh, motion).vertices);
  result.deformed_body = transformed(naked.mesh, motion);
  result.body_rms_m = rms_distance(result.deformed_body, MeshQuery(user.mesh));
  return result;
}

const Fit::Variant uniform_variant{"uniform", uniform};

}  // namespace
}  // namespace dressform
