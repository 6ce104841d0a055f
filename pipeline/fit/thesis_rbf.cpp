// The thesis's resizing (section 3.6): the mannequin brought to the user by rigid ICP (Besl and McKay, PAMI 1992), then
// one radial basis function through pairs of points that a person picked on both bodies (Carr et al., SIGGRAPH 2001;
// Noh, Fidaleo and Neumann, VRST 2000), which moves body and clothes alike. The thesis does not name its kernel: r with
// an affine part is the function through the pairs that bends least in three dimensions (Duchon, 1977).
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "pipeline/fit/fit.h"
#include "pipeline/fit/fit_result.h"
#include "pipeline/fit/rbf_field.h"
#include "scenes/error.h"
#include "scenes/picks.h"

namespace dressform {
namespace {

constexpr std::size_t kFewestPairs = 5;  // four fix an affine map, and nothing of a body's shape

struct ThesisRbfParams {
  std::string kernel = "r";
  double smoothing_m = 0;
  int icp_rounds = 30;
};
template <class V>
void fields(V& v, ThesisRbfParams& p) {
  v("kernel", p.kernel, {"r", "r3", "thin_plate"}, "radial basis function beside the affine part: r, r^3, r^2 log r");
  v("smoothing_m", p.smoothing_m, 0.0, 1.0, "m",
    "how much the map may miss the picked targets for smoothness, for r; 0: it takes every control to its target");
  v("icp_rounds", p.icp_rounds, 0, 1000, "", "of the rigid alignment of mannequin and user");
}

RbfField::Kernel kernel_of(const std::string& name) {
  if (name == "r3") return RbfField::Kernel::cubic;
  return name == "r" ? RbfField::Kernel::linear : RbfField::Kernel::thin_plate;
}

// The points picked under a name, all in the frame they have to be in.
std::vector<Vector3d> points_in(const Picks& picks, const std::string& name, const std::string& frame) {
  std::vector<Vector3d> points;
  const auto found = picks.points.find(name);
  if (found == picks.points.end()) return points;
  for (const PickedPoints& part : found->second) {
    if (part.frame != frame)
      throw InputError("picks/" + name, "found points in the frame \"" + part.frame + "\"; expected \"" + frame + "\"");
    points.insert(points.end(), part.points.begin(), part.points.end());
  }
  return points;
}

// How many frames the points of a name were picked in: what their places are does not say how the frames follow.
std::size_t parts_of(const Picks& picks, const std::string& name) {
  const auto found = picks.points.find(name);
  return found == picks.points.end() ? 0 : found->second.size();
}

struct PickedPairs {
  std::vector<Vector3d> controls, targets;  // in the model's frame, in the user's
};
PickedPairs picked_pairs(const Picks& picks) {
  PickedPairs pairs{points_in(picks, "control", "model"), points_in(picks, "target", "user")};
  const std::string where = "picks/model/control and picks/user/target";
  const std::string how =
      ": pick control on naked_body.ply and target on user_body.ply of a run with MeshLab (PickPoints), the same "
      "places in the same order (scenes/README.md, \"Picks\")";
  if (pairs.controls.size() != pairs.targets.size())
    throw InputError(where, "found " + std::to_string(pairs.controls.size()) + " control points and " +
                                std::to_string(pairs.targets.size()) + " targets; expected one for each" + how);
  if (parts_of(picks, "control") > 1 && parts_of(picks, "target") > 1)
    throw InputError(where, "found control points in " + std::to_string(parts_of(picks, "control")) +
                                " frames and targets in " + std::to_string(parts_of(picks, "target")) +
                                ", so that their order says nothing of which belong together; expected one frame of "
                                "one of them" +
                                how);
  if (pairs.controls.size() < kFewestPairs)
    throw InputError(where, "found " + std::to_string(pairs.controls.size()) + " pairs; expected at least " +
                                std::to_string(kFewestPairs) + ", the thesis has 200" + how);
  return pairs;
}

// The rigid motion that takes the mannequin's vertices nearest to the user's surface, from a start: point to point.
Eigen::Matrix4d aligned(const Mesh& mannequin, const MeshQuery& user, Eigen::Matrix4d motion, int rounds) {
  constexpr double kSettled_m = 1e-5;
  constexpr std::size_t kMostPoints = 4000;  // evenly over the mesh's order: more move no rigid fit of bodies
  const std::size_t stride = 1 + mannequin.vertices.size() / kMostPoints;
  const auto count = static_cast<Eigen::Index>((mannequin.vertices.size() + stride - 1) / stride);
  Eigen::Matrix3Xd from(3, count), to(3, count);
  for (Eigen::Index i = 0; i < count; ++i) from.col(i) = mannequin.vertices[i * stride];
  for (int round = 0; round < rounds; ++round) {
    tbb::parallel_for(Eigen::Index{0}, count, [&](Eigen::Index i) {
      const Vector3d at = motion.topLeftCorner<3, 3>() * from.col(i) + motion.topRightCorner<3, 1>();
      to.col(i) = user.closest(at).point;
    });
    const Eigen::Matrix4d next = Eigen::umeyama(from, to, false);
    const double moved =
        ((next - motion) * from.rowwise().mean().homogeneous()).norm() + (next - motion).topLeftCorner<3, 3>().norm();
    motion = next;
    if (moved < kSettled_m) break;
  }
  return motion;
}

FittedGarments thesis_rbf(const KnownBody& naked, const KnownBody& user, const TexturedGarments& clothes,
                          const GarmentLayouts& layouts, const ThesisRbfParams& params, const Picks& picks) {
  require_bodies(naked, user, "fit.thesis_rbf");
  PickedPairs pairs = picked_pairs(picks);
  const MeshQuery user_surface(user.body);
  const Eigen::Matrix4d motion =
      aligned(naked.body, user_surface, user_from_naked(naked.landmarks, user.landmarks), params.icp_rounds);
  for (Vector3d& control : pairs.controls) control = (motion * control.homogeneous()).head<3>();
  const RbfField field(pairs.controls, pairs.targets, kernel_of(params.kernel), params.smoothing_m);

  FittedGarments result;
  for (const auto& [name, garment] : clothes.garments) {
    const Mesh turned = transformed(garment.mesh, motion);
    const Mesh fitted{field(turned.vertices), turned.triangles};
    result.foldovers += count_foldovers(turned, fitted);
    add_fitted(name, garment, fitted.vertices, layout_of(name, layouts, "fit.thesis_rbf"), user, user_surface, result);
  }
  result.deformed_body = transformed(naked.body, motion);
  result.deformed_body.vertices = field(result.deformed_body.vertices);
  result.body_rms_m = rms_distance(result.deformed_body, user_surface);
  result.control_points = field.control_points();
  return result;
}

const Fit::Variant thesis_rbf_variant{"thesis_rbf", thesis_rbf, {"control", "target"}};

}  // namespace
}  // namespace dressform
