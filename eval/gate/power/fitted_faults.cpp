// Faults in the garments on the user.
#include <algorithm>

#include "eval/gate/power/fault.h"
#include "eval/gate/power/fault_shapes.h"
#include "pipeline/correct/correct.h"
#include "pipeline/fit/fit.h"

namespace dressform {
namespace {

template <class Made>
Mesh* one_fitted(Made& made, const Placement& place) {
  const auto found = made.garments.find(place.one_of(made.garments));
  return found == made.garments.end() || found->second.mesh.vertices.empty() ? nullptr : &found->second.mesh;
}

// Wider or narrower about the upright axis through its middle; its height stays.
template <class Made>
void widen(Made& made, double size_percent, const Placement& place) {
  Mesh* mesh = one_fitted(made, place);
  if (!mesh) return;
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh->vertices) box.extend(vertex);
  const Vector3d centre = box.center();
  for (auto& vertex : mesh->vertices)
    for (const int axis : {0, 2})
      vertex[axis] = centre[axis] + (1 + size_percent / 100) * (vertex[axis] - centre[axis]);
}
template <class Made>
void shift_fitted(Made& made, double size_mm, const Placement& place) {
  if (Mesh* mesh = one_fitted(made, place)) shift(*mesh, size_mm / 1000 * place.direction(1));
}
template <class Made>
void shake_fitted(Made& made, double size_mm, const Placement& place) {
  if (Mesh* mesh = one_fitted(made, place)) shake(*mesh, size_mm / 1000, place);
}
template <class Made>
void turn_fitted(Made& made, double size_deg, const Placement& place) {
  if (Mesh* mesh = one_fitted(made, place)) turn_about_centre(*mesh, size_deg, Vector3d::UnitY());
}

void press(CorrectedGarments& corrected, double size_mm, const Placement& place) {
  if (Mesh* mesh = one_fitted(corrected, place)) blow(*mesh, -size_mm / 1000);
}
void loosen(CorrectedGarments& corrected, double size_mm, const Placement& place) {
  if (Mesh* mesh = one_fitted(corrected, place)) blow(*mesh, size_mm / 1000);
}
void pull_out(CorrectedGarments& corrected, double size_mm, const Placement& place) {
  constexpr double kRadiusM = 0.05;
  if (Mesh* mesh = one_fitted(corrected, place)) dent(*mesh, kRadiusM, -size_mm / 1000, place);
}

void lose_fitted(CorrectedGarments& corrected, double, const Placement& place) {
  corrected.garments.erase(place.one_of(corrected.garments));
}

}  // namespace

std::vector<Fault> fitted_faults() {
  using Fitted = FittedGarments;
  using Corrected = CorrectedGarments;
  return {
      artifact_fault<Fitted>("fit", "widened", "%", {1, 3, 10}, "a fitted garment too wide", widen<Fitted>),
      artifact_fault<Fitted>("fit", "narrowed", "%", {-1, -3, -10}, "a fitted garment too narrow", widen<Fitted>),
      artifact_fault<Fitted>("fit", "shifted", "mm", {3, 12, 40}, "a fitted garment moved", shift_fitted<Fitted>),
      artifact_fault<Fitted>("fit", "turned", "deg", {2, 8, 30}, "a fitted garment turned", turn_fitted<Fitted>),
      artifact_fault<Fitted>("fit", "noisy", "mm", {0.5, 2, 6}, "noise on a fitted garment", shake_fitted<Fitted>),
      artifact_fault<Corrected>("correct", "pressed", "mm", {1, 4, 12}, "cloth pressed into the body", press),
      artifact_fault<Corrected>("correct", "loosened", "mm", {1, 4, 12}, "cloth off the body", loosen),
      artifact_fault<Corrected>("correct", "pulled", "mm", {10, 40, 120}, "a spike of 10 cm across", pull_out),
      artifact_fault<Corrected>("correct", "lost", "there", {1}, "one garment missing", lose_fitted),
  };
}

}  // namespace dressform
