// Balls rolled over the aligned points, as with Open3D or MeshLab: Bernardini, Mittleman, Rushmeier, Silva and Taubin,
// "The ball-pivoting algorithm for surface reconstruction", TVCG 1999. The sheet that comes out is open wherever points
// are missing; it is closed by its winding number (geometry/winding_number.h), because the stage promises a solid.
#include "pipeline/geometry/point_sheets.h"
#include "pipeline/surface/closed_cloth.h"

namespace dressform {
namespace {

struct BallPivotingParams {
  GarmentCloudParams cloud;  // smoothed: balls fall through noise as large as the points' spacing
  int normal_neighbours = 20;
  double first_radius = 1.5;
  int radii = 3;
  double step_m = 0.006;
  int fewest_points = 300;
};
template <class V>
void fields(V& v, BallPivotingParams& p) {
  fields(v, p.cloud);
  v("normal_neighbours", p.normal_neighbours, 4, 200, "",
    "least nearest points whose principal components give a normal; more where more lie within 35 mm");
  v("first_radius", p.first_radius, 0.5, 20.0, "", "of the smallest ball, over the points' median spacing");
  v("radii", p.radii, 1, 8, "", "balls, each twice as large as the one before");
  v("step_m", p.step_m, 0.003, 0.03, "m", "of the lattice on which holes are closed and webs taken out");
  v("fewest_points", p.fewest_points, 50, 100000, "", "a garment with fewer points is left out");
}

ClosedGarments ball_pivoting(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                             const Registration& registration, const FilledViews& filled,
                             const GarmentLayouts& segmented, const BallPivotingParams& params) {
  const auto make = [&](const ClothTask& task) {
    std::vector<double> radii_m{params.first_radius * median_spacing_m(task.support.points)};
    if (radii_m[0] <= 0) return Mesh{};
    while (static_cast<int>(radii_m.size()) < params.radii) radii_m.push_back(2 * radii_m.back());
    return closed_sheet(task, ball_pivoting_sheet(task.support, radii_m), params.step_m, params.cloud.see_through_m);
  };
  return closed_cloths(session, calibration, naked, registration, filled, segmented, params.cloud,
                       params.normal_neighbours, params.fewest_points, "surface.ball_pivoting", make);
}

const Surface::Variant ball_pivoting_variant{"ball_pivoting", ball_pivoting};

}  // namespace
}  // namespace dressform
