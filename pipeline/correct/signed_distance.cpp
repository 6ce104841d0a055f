// Each vertex of cloth inside the body, or nearer than the gap, goes to the nearest point of the surface and the gap
// beyond it: once, and nothing else moves.

#include "pipeline/correct/correct_result.h"
#include "pipeline/geometry/mesh_query.h"

namespace dressform {
namespace {

struct SignedDistanceParams {
  double gap_m = 0.003;
};
template <class V>
void fields(V& v, SignedDistanceParams& p) {
  v("gap_m", p.gap_m, 0.0, 0.02, "m", "least distance of a vertex of cloth from the body");
}

CorrectedGarments signed_distance(const KnownBody& user, const FittedGarments& fitted,
                                  const SignedDistanceParams& params) {
  require_user(user, "correct.signed_distance");
  const MeshQuery body(user.body);
  return each_vertex_moved(user, fitted, [&](const Vector3d& p) -> Vector3d {
    const auto closest = body.closest(p);
    const double distance = body.signed_distance(p, closest);
    if (distance >= params.gap_m) return p;
    const Vector3d out = (distance < 0 ? -1 : 1) * (p - closest.point);
    const Vector3d direction = out.norm() > 1e-6 ? Vector3d(out.normalized()) : body.normal(closest.triangle);
    return closest.point + params.gap_m * direction;
  });
}

const Correct::Variant signed_distance_variant{"signed_distance", signed_distance};

}  // namespace
}  // namespace dressform
