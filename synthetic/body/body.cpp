#include "synthetic/body/body.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "scenes/mesh_io.h"
#include "synthetic/body/body_measure.h"
#include "synthetic/body/mannequin.h"
#include "synthetic/body/section.h"
#include "synthetic/geometry/contour.h"

namespace dressform {
namespace {

constexpr double kStep = 0.008;  // edge of the body's triangles, m

// Distance along a ray from the torso's axis to the first place where it leaves the body.
double leave_body(const Mannequin& mannequin, const Vector3d& origin, const Vector3d& direction) {
  double inside = 0, outside = 0;
  while (outside < 0.6) {
    const double value = mannequin.field(origin + outside * direction);
    if (value >= 0 && outside > 0.02) break;
    inside = outside;
    outside += std::max(0.002, 0.5 * -value);
  }
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (inside + outside);
    (mannequin.field(origin + middle * direction) < 0 ? inside : outside) = middle;
  }
  return outside;
}

double field_girth(const Mannequin& mannequin, double y) {
  constexpr int kRays = 360;
  std::vector<Vector2d> points;
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2 * M_PI * i / kRays;
    const Vector3d direction(std::cos(angle), 0, std::sin(angle));
    const double r = leave_body(mannequin, Vector3d(0, y, 0), direction);
    points.emplace_back(r * direction.x(), r * direction.z());
  }
  return polygon_length(convex_hull(std::move(points)));
}

// Each girth follows its own factor almost alone: secant steps on all three at once.
Mannequin solve_girths(const BodySpec& spec, const Proportions& proportions, const Vector3d& asked) {
  GirthFactors factors;
  double* const factor[3] = {&factors.chest, &factors.waist, &factors.hip};
  Vector3d previous_error = Vector3d::Zero(), previous_factor = Vector3d::Zero();
  double worst = 0;
  for (int round = 0; round < 25; ++round) {
    Mannequin mannequin = make_mannequin(spec, proportions, factors);
    const double heights[3] = {mannequin.landmarks.chest, mannequin.landmarks.waist, mannequin.landmarks.hip};
    worst = 0;
    for (int i = 0; i < 3; ++i) {
      const double error = field_girth(mannequin, heights[i]) - asked[i], moved = *factor[i] - previous_factor[i];
      double slope = asked[i];
      if (round > 0 && std::abs(moved) > 1e-7)
        slope = std::clamp((error - previous_error[i]) / moved, 0.3 * asked[i], 2 * asked[i]);
      worst = std::max(worst, std::abs(error));
      previous_error[i] = error;
      previous_factor[i] = *factor[i];
      *factor[i] = std::clamp(*factor[i] - error / slope, 0.5, 2.0);
    }
    if (worst < 1e-4) return mannequin;
  }
  throw InputError("body", fmt::format("no figure has these girths (off by {:.0f} mm); expected measures of a person",
                                       1000 * worst));
}

// Soles at 0 and top of the head at the stature, exactly.
void fit_stature(Mesh& mesh, double stature) {
  double low = 1e9, high = -1e9;
  for (const Vector3d& v : mesh.vertices) {
    low = std::min(low, v.y());
    high = std::max(high, v.y());
  }
  for (Vector3d& v : mesh.vertices) v.y() = (v.y() - low) * stature / (high - low);
}

// The mesh cuts the field's corners by a fraction of a millimetre: what is asked of the field is corrected by what is
// then measured on the mesh.
Body procedural_body(const BodySpec& spec) {
  const BodyMeasures measures{spec.stature_m, spec.chest_m, spec.waist_m, spec.hip_m};
  check_measures(spec.sex, measures);
  const Proportions proportions = predict_proportions(spec.sex, measures);
  const Vector3d wanted(spec.chest_m, spec.waist_m, spec.hip_m);
  Vector3d asked = wanted;
  for (int round = 0;; ++round) {
    const Mannequin mannequin = solve_girths(spec, proportions, asked);
    const BodyLandmarks& marks = mannequin.landmarks;
    Mesh mesh = contour([&](const Vector3d& p) { return mannequin.field(p); }, mannequin.box, kStep);
    fit_stature(mesh, spec.stature_m);
    const Vector3d measured(tape_girth(mesh, marks.chest), tape_girth(mesh, marks.waist), tape_girth(mesh, marks.hip));
    const double worst = (measured - wanted).cwiseAbs().maxCoeff();
    if (worst < 2e-4) return {std::move(mesh), marks, mannequin.joints};
    if (round == 3)
      throw InputError("body",
                       fmt::format("the girths come out {:.1f} mm off; expected measures of a person", 1000 * worst));
    asked += wanted - measured;
  }
}

}  // namespace

Body make_body(const BodySpec& spec) {
  return spec.mesh.empty() ? procedural_body(spec) : measure_body(read_mesh(spec.mesh), spec.mesh.string());
}

}  // namespace dressform
