// Cloth pushed out of the body by exact signed distances, pushes diffused over the cloth, repeated until exact
// predicates find no triangle of one that meets a triangle of the other.
#include "pipeline/body/body_landmarks.h"
#include "pipeline/correct/correct_result.h"
#include "pipeline/correct/push_out.h"
#include "pipeline/garment/sleeves.h"
#include "scenes/error.h"

namespace dressform {
namespace {

constexpr double kPastSleeve_m =
    0.06;  // of the arm may still lie inside the cloth: a bin of the sleeve's end and a half

struct SignedDistanceSmoothParams {
  double gap_m = 0.003;
  int rounds = 60;
  int diffusion_rounds = 12;
};
template <class V>
void fields(V& v, SignedDistanceSmoothParams& p) {
  v("gap_m", p.gap_m, 0.0005, 0.02, "m", "least distance of a vertex of cloth from the body");
  v("rounds", p.rounds, 1, 500, "", "of pushing at most");
  v("diffusion_rounds", p.diffusion_rounds, 0, 100, "", "rings of neighbours over which a push fades");
}

CorrectedGarments signed_distance_smooth(const KnownBody& user, const FittedGarments& fitted,
                                         const SignedDistanceSmoothParams& params) {
  require_user(user, "correct.signed_distance_smooth");
  const MeshQuery body(user.body);
  const IntersectionFinder finder(user.body);
  CorrectedGarments result;
  for (const auto& [name, garment] : fitted.garments) {
    const auto layout = fitted.layouts.find(name);
    if (layout == fitted.layouts.end())
      throw InputError("correct.signed_distance_smooth", "no layout of the garment \"" + name + "\"; expected fit's");
    const auto beside = exposed_arm_triangles(user, layout->second, kPastSleeve_m);
    PushedOut pushed =
        push_out(garment.mesh, body, finder, beside, {params.gap_m, params.rounds, params.diffusion_rounds});
    add_corrected(name, garment, std::move(pushed.vertices), pushed.intersecting_pairs, result);
  }
  return result;
}

const Correct::Variant signed_distance_smooth_variant{"signed_distance_smooth", signed_distance_smooth};

}  // namespace
}  // namespace dressform
