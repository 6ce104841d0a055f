#include "synthetic/body/body.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "scenes/mesh_io.h"
#include "synthetic/body/anthropometry.h"
#include "synthetic/body/body_measure.h"
#include "synthetic/body/figure_solver.h"
#include "synthetic/body/section.h"
#include "synthetic/geometry/contour.h"
#include "synthetic/geometry/mending.h"

namespace dressform {
namespace {

constexpr double kStep = 0.008;  // edge of the body's triangles, m

// Soles at 0 and top of the head at the stature, exactly.
void fit_stature(Mesh& mesh, double stature) {
  double low = 1e9, high = -1e9;
  for (const Vector3d& v : mesh.vertices) {
    low = std::min(low, v.y());
    high = std::max(high, v.y());
  }
  for (Vector3d& v : mesh.vertices) v.y() = (v.y() - low) * stature / (high - low);
}

// Height at which the legs part, to 0.1 mm: two large sections below, one above.
double crotch_on(const Mesh& mesh, double expected) {
  double low = expected - 0.03, high = expected + 0.03;
  while (high - low > 1e-4) {
    const double middle = 0.5 * (low + high);
    (torso_part(horizontal_section(mesh, middle)).size() == 2 ? low : high) = middle;
  }
  return low;
}

// Above the waist every level is moved forward, more the higher it is: sections and heights stay what they are.
Body hunched(Body body, double forward_m) {
  if (forward_m == 0) return body;
  const double waist = body.landmarks.waist, back = body.landmarks.neck - waist;
  const auto bend = [=](Vector3d& p) { p.z() += forward_m * std::pow(std::max(0.0, p.y() - waist) / back, 2); };
  for (Vector3d& v : body.mesh.vertices) bend(v);
  for (auto& [name, place] : body.joints) bend(place);
  return body;
}

// The mesh cuts the field's corners by a fraction of a millimetre: what is asked of the field is corrected by what is
// then measured on the mesh.
Body procedural_body(const BodySpec& spec) {
  check_measures(spec);
  const Prediction sizes = predict_sizes(spec.sex, known_measures(spec));
  FigureShape shape;
  SolverOffsets offsets;
  // The narrow cleft between the thighs closes a little lower on the mesh than in the field.
  offsets.crotch = 0.006;
  for (int round = 0;; ++round) {
    const Mannequin mannequin = solve_figure(spec, sizes, offsets, shape);
    const BodyLandmarks& marks = mannequin.landmarks;
    Mesh mesh = contour([&](const Vector3d& p) { return mannequin.field(p); }, mannequin.box, kStep);
    fit_stature(mesh, spec.stature_m);
    const Vector3d error(spec.chest_m - tape_girth(mesh, marks.chest), spec.waist_m - tape_girth(mesh, marks.waist),
                         spec.hip_m - tape_girth(mesh, marks.hip));
    const double crotch_error = spec.inseam_m > 0 ? spec.inseam_m - crotch_on(mesh, spec.inseam_m) : 0;
    const double worst = std::max(error.cwiseAbs().maxCoeff(), std::abs(crotch_error));
    if (worst < 7e-4) return hunched({std::move(mesh), marks, mannequin.joints}, spec.hunch_m);
    if (round == 6)
      throw InputError(
          "body", fmt::format("girths or inseam come out {:.1f} mm off; expected measures of a person", 1000 * worst));
    offsets.chest += error[0];
    offsets.waist += error[1];
    offsets.hip += error[2];
    offsets.crotch += crotch_error;
  }
}

// How far a box is from that of a standing person; infinite where it cannot be one.
double misfit_of_person(const Box& box) {
  constexpr double kSmallest_m = 0.5, kTallest_m = 2.5, kUsual_m = 1.7;  // a small child to a giant
  constexpr double kWidest = 1.3, kDeepest = 0.8;                        // of the height: arms held out, a bent knee
  const Vector3d size = box.sizes();
  const bool stands = size.y() >= kSmallest_m && size.y() <= kTallest_m && size.x() <= kWidest * size.y() &&
                      size.z() <= kDeepest * size.y();
  return stands ? std::abs(size.y() - kUsual_m) + std::abs(box.min().y()) : INFINITY;
}

void check_place(const Mesh& mesh, const BodySpec& spec) {
  const Box box = bounding_box(mesh);
  const std::string where = spec.mesh.string();
  if (!std::isfinite(misfit_of_person(box)))
    throw InputError(where,
                     fmt::format("found a body {:.3g} m high (y), {:.3g} wide (x) and {:.3g} deep (z); expected a "
                                 "standing person of 0.5 to 2.5 m, in metres with y up{}",
                                 box.sizes().y(), box.sizes().x(), box.sizes().z(),
                                 likely_frame(box, spec.frame, misfit_of_person)));
  constexpr double kOnFloor_m = 0.03;  // soles of shoes, and scans that sink in
  const double low = box.min().y();
  if (std::abs(low) > kOnFloor_m)
    throw InputError(where,
                     fmt::format("stands {:.3f} m {} the floor (its lowest point is at y = {:.3f} m); expected feet "
                                 "at y = 0 within {} m; say lift_m = {:.3f} for it and for its clothes",
                                 std::abs(low), low < 0 ? "below" : "above", low, kOnFloor_m, spec.frame.lift_m - low));
}

Body own_body(const BodySpec& spec) {
  const std::string where = spec.mesh.string();
  const Mesh mesh = in_world(read_mesh(spec.mesh), spec.frame);
  check_place(mesh, spec);
  return measure_body(mended({mesh, {}, {}}, where).textured.mesh, where);
}

}  // namespace

Body make_body(const BodySpec& spec) {
  if (!spec.mesh.empty()) return own_body(spec);
  return procedural_body(drawn_customer(spec));
}

}  // namespace dressform
