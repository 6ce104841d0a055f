// Li and Lu, "Customizing 3D garments based on volumetric deformation", Computers in Industry 2011 (section 2.5.6 of
// the thesis): the space about the naked body is meshed, the mesh follows the body's cross-sections to the user's while
// its Laplacian coordinates change least, and the clothes are decoded from the cells that they lie in. Here the mesh is
// a lattice's, in place of their five of tetrahedra.
#include "pipeline/fit/displacement_lattice.h"
#include "pipeline/fit/map_fit.h"

namespace dressform {
namespace {

struct VolumetricParams {
  double step_m = 0.08;
  double stiffness = 0.05;
  double margin_m = 0.15;
};
template <class V>
void fields(V& v, VolumetricParams& p) {
  v("step_m", p.step_m, 0.04, 0.5, "m", "edge of the cells that the space is meshed into");
  v("stiffness", p.stiffness, 1e-6, 100.0, "", "weight of the mesh's Laplacian coordinates against the cross-sections");
  v("margin_m", p.margin_m, 0.05, 1.0, "m", "how far the mesh reaches beyond the body");
}

FittedGarments volumetric(const KnownBody& naked, const KnownBody& user, const TexturedGarments& clothes,
                          const GarmentLayouts& layouts, const VolumetricParams& params) {
  return fitted_by_map(naked, user, clothes, layouts, "fit.volumetric",
                       [&](const Mesh& body, const auto& controls, const auto& targets) {
                         const DisplacementLattice lattice(box_round(body, params.margin_m), params.step_m,
                                                           DisplacementLattice::Between::linear, params.stiffness,
                                                           controls, targets);
                         return SpaceMap([lattice](const Vector3d& point) { return lattice(point); });
                       });
}

const Fit::Variant volumetric_variant{"volumetric", volumetric};

}  // namespace
}  // namespace dressform
