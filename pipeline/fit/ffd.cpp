// Free-form deformation: Sederberg and Parry, SIGGRAPH 1986 (section 2.5.6.1 of the thesis), its control points found
// by least squares from the pairs, as in Hsu, Hughes and Kaufman, "Direct manipulation of free-form deformations",
// SIGGRAPH 1992, with their cubic B-splines.
#include "pipeline/fit/displacement_lattice.h"
#include "pipeline/fit/map_fit.h"

namespace dressform {
namespace {

struct FfdParams {
  double step_m = 0.2;
  double stiffness = 0.01;
  double margin_m = 0.2;
};
template <class V>
void fields(V& v, FfdParams& p) {
  v("step_m", p.step_m, 0.05, 1.0, "m", "between control points of the lattice");
  v("stiffness", p.stiffness, 1e-6, 100.0, "", "weight of the control points' second differences against the pairs");
  v("margin_m", p.margin_m, 0.05, 1.0, "m", "room for clothes between the body and the lattice's sides");
}

FittedGarments ffd(const KnownBody& naked, const KnownBody& user, const TexturedGarments& clothes,
                   const GarmentLayouts& layouts, const FfdParams& params) {
  return fitted_by_map(
      naked, user, clothes, layouts, "fit.ffd", [&](const Mesh& body, const auto& controls, const auto& targets) {
        const DisplacementLattice lattice(box_round(body, params.margin_m), params.step_m,
                                          DisplacementLattice::Between::cubic, params.stiffness, controls, targets);
        return SpaceMap([lattice](const Vector3d& point) { return lattice(point); });
      });
}

const Fit::Variant ffd_variant{"ffd", ffd};

}  // namespace
}  // namespace dressform
