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
    if (worst < 7e-4) return {std::move(mesh), marks, mannequin.joints};
    if (round == 6)
      throw InputError(
          "body", fmt::format("girths or inseam come out {:.1f} mm off; expected measures of a person", 1000 * worst));
    offsets.chest += error[0];
    offsets.waist += error[1];
    offsets.hip += error[2];
    offsets.crotch += crotch_error;
  }
}

}  // namespace

Body make_body(const BodySpec& spec) {
  if (!spec.mesh.empty()) return measure_body(read_mesh(spec.mesh), spec.mesh.string());
  return procedural_body(drawn_customer(spec));
}

}  // namespace dressform
