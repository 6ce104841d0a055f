// Carr, Beatson, Cherrie, Mitchell, Fright, McCallum and Evans, "Reconstruction and representation of 3D objects with
// radial basis functions", SIGGRAPH 2001 (section 2.5.4.1 of the thesis): a biharmonic function that is zero on the
// points and the distance off them, with greedily chosen centres. Their fast multipole evaluation is not needed for the
// few thousand centres that a garment takes.
#include <utility>

#include "pipeline/geometry/ball_mesh.h"
#include "pipeline/geometry/biharmonic_field.h"
#include "pipeline/surface/closed_cloth.h"
#include "pipeline/surface/signed_samples.h"

namespace dressform {
namespace {

constexpr double kNearestSide_m = 0.001;  // samples nearer to the surface than this say nothing of its sides

struct RbfCarrParams {
  GarmentCloudParams cloud;  // smoothed: centres would be spent on noise
  GreedyFit fit;
  int normal_neighbours = 20;
  double offset_m = 0.01;
  int offset_every = 2;
  double step_m = 0.006;
  int fewest_points = 300;
};
template <class V>
void fields(V& v, RbfCarrParams& p) {
  fields(v, p.cloud);
  v("normal_neighbours", p.normal_neighbours, 4, 200, "",
    "least nearest points whose principal components give a normal; more where more lie within 35 mm");
  v("offset_m", p.offset_m, 0.002, 0.1, "m", "of the samples beside the surface; halved where it would cross another");
  v("offset_every", p.offset_every, 1, 100, "", "of the points, one has samples beside it");
  v("first_centres", p.fit.first_centres, 20, 5000, "", "centres of the first function");
  v("growth", p.fit.growth, 0.05, 2.0, "", "centres added a round, over those that are there: the samples missed most");
  v("most_centres", p.fit.most_centres, 20, 5000, "", "centres at most: time grows with their cube");
  v("tolerance_m", p.fit.tolerance_m, 1e-4, 0.05, "m", "samples missed by less get no centre");
  v("smoothing_m", p.fit.smoothing_m, 0.0, 0.1, "m", "how much the function may miss its centres for smoothness");
  v("apart_m", p.fit.apart_m, 1e-4, 0.1, "m", "centres of one round are at least about this far apart");
  v("step_m", p.step_m, 0.003, 0.03, "m", "of the lattice on which the zero is found, and webs are taken out");
  v("fewest_points", p.fewest_points, 50, 100000, "", "a garment with fewer points is left out");
}

Mesh zero_of_biharmonic(const ClothTask& task, const RbfCarrParams& params) {
  const SignedSamples samples = signed_samples(task.support, params.offset_m, kNearestSide_m, params.offset_every);
  const std::vector<std::size_t> centres = greedy_centres(samples, params.fit);
  if (centres.empty()) return {};
  std::vector<Vector3d> points;
  std::vector<double> values;
  for (const std::size_t i : centres) {
    points.push_back(samples.points[i]);
    values.push_back(samples.distances_m[i]);
  }
  const BiharmonicField function(std::move(points), values, params.fit.smoothing_m);
  const Lattice lattice = lattice_round(Mesh{task.support.points, {}}, params.step_m);
  std::vector<Vector3d> nodes(lattice.count());
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = lattice.point(i);
  const std::vector<double> at_nodes = function(nodes);
  return closed_level_set(task, lattice, {at_nodes.begin(), at_nodes.end()}, params.cloud.see_through_m);
}

ClosedGarments rbf_carr(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                        const Registration& registration, const FilledViews& filled, const GarmentLayouts& segmented,
                        const RbfCarrParams& params) {
  return closed_cloths(session, calibration, naked, registration, filled, segmented, params.cloud,
                       params.normal_neighbours, params.fewest_points, "surface.rbf_carr",
                       [&](const ClothTask& task) { return zero_of_biharmonic(task, params); });
}

const Surface::Variant rbf_carr_variant{"rbf_carr", rbf_carr};

}  // namespace
}  // namespace dressform
