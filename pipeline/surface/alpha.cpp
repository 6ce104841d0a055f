// The alpha shape of the aligned points, as with Open3D or CGAL: Edelsbrunner and Muecke, "Three-dimensional alpha
// shapes", ACM TOG 1994. Of a garment, which is open at its ends, it is a shell with two sides; both face outwards
// here, and the shell is closed by its winding number (geometry/winding_number.h), because the stage promises a solid.
#include "pipeline/geometry/point_sheets.h"
#include "pipeline/surface/closed_cloth.h"

namespace dressform {
namespace {

struct AlphaParams {
  GarmentCloudParams cloud;  // smoothed: the shell is as thick as the noise
  int normal_neighbours = 20;
  double alpha = 5;
  double step_m = 0.006;
  int fewest_points = 300;
};
template <class V>
void fields(V& v, AlphaParams& p) {
  fields(v, p.cloud);
  v("normal_neighbours", p.normal_neighbours, 4, 200, "",
    "least nearest points whose principal components give a normal; more where more lie within 35 mm");
  v("alpha", p.alpha, 1.0, 50.0, "", "radius of the ball that no tetrahedron is larger than, over the median spacing");
  v("step_m", p.step_m, 0.003, 0.03, "m", "of the lattice on which holes are closed and webs taken out");
  v("fewest_points", p.fewest_points, 50, 100000, "", "a garment with fewer points is left out");
}

ClosedGarments alpha(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                     const Registration& registration, const FilledViews& filled, const GarmentLayouts& segmented,
                     const AlphaParams& params) {
  const auto make = [&](const ClothTask& task) {
    const double alpha_m = params.alpha * median_spacing_m(task.support.points);
    if (alpha_m <= 0) return Mesh{};
    return closed_sheet(task, alpha_shape_sheet(task.support, alpha_m), params.step_m, params.cloud.see_through_m);
  };
  return closed_cloths(session, calibration, naked, registration, filled, segmented, params.cloud,
                       params.normal_neighbours, params.fewest_points, "surface.alpha", make);
}

const Surface::Variant alpha_variant{"alpha", alpha};

}  // namespace
}  // namespace dressform
