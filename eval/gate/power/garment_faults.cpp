// Faults in the garments on the mannequin: closed, opened, textured.
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/gate/power/fault.h"
#include "eval/gate/power/fault_shapes.h"
#include "pipeline/open/open.h"
#include "pipeline/surface/surface.h"
#include "pipeline/texture/texture.h"

namespace dressform {
namespace {

// The mesh of one garment of a result that has them by slot; null where there is none.
template <class Made>
Mesh* one_mesh(Made& made, const Placement& place) {
  const auto found = made.garments.find(place.one_of(made.garments));
  return found == made.garments.end() || found->second.mesh.vertices.empty() ? nullptr : &found->second.mesh;
}

template <class Made>
void blow_one(Made& made, double size_mm, const Placement& place) {
  if (Mesh* mesh = one_mesh(made, place)) blow(*mesh, size_mm / 1000);
}
template <class Made>
void shake_one(Made& made, double size_mm, const Placement& place) {
  if (Mesh* mesh = one_mesh(made, place)) shake(*mesh, size_mm / 1000, place);
}
template <class Made>
void shift_one(Made& made, double size_mm, const Placement& place) {
  if (Mesh* mesh = one_mesh(made, place)) shift(*mesh, size_mm / 1000 * place.direction(1));
}
template <class Made>
void scale_one(Made& made, double size_percent, const Placement& place) {
  if (Mesh* mesh = one_mesh(made, place)) scale_about_centre(*mesh, 1 + size_percent / 100);
}

void dent_closed(ClosedGarments& closed, double size_mm, const Placement& place) {
  constexpr double kRadiusM = 0.08;
  if (Mesh* mesh = one_mesh(closed, place)) dent(*mesh, kRadiusM, size_mm / 1000, place);
}

void hole_in_open(OpenGarments& opened, double size_mm, const Placement& place) {
  Mesh* mesh = one_mesh(opened, place);
  if (!mesh) return;
  const auto gone = triangles_at_a_spot(*mesh, size_mm / 2000, place);
  for (auto it = gone.rbegin(); it != gone.rend(); ++it) mesh->triangles.erase(mesh->triangles.begin() + *it);
  *mesh = compacted(*mesh);
}

// What hangs lowest drawn up: a hem, ankles.
void shorten_open(OpenGarments& opened, double size_mm, const Placement& place) {
  Mesh* mesh = one_mesh(opened, place);
  if (!mesh) return;
  double low = mesh->vertices.front().y(), high = low;
  for (const auto& vertex : mesh->vertices) low = std::min(low, vertex.y()), high = std::max(high, vertex.y());
  const double factor = (high - low - size_mm / 1000) / std::max(high - low, 1e-9);
  for (auto& vertex : mesh->vertices) vertex.y() = high + factor * (vertex.y() - high);
}

cv::Mat* one_texture(TexturedGarments& textured, const Placement& place) {
  const auto found = textured.garments.find(place.one_of(textured.garments));
  return found == textured.garments.end() || found->second.texture.empty() ? nullptr : &found->second.texture;
}

void blur_texture(TexturedGarments& textured, double size_px, const Placement& place) {
  if (cv::Mat* image = one_texture(textured, place)) blur_image(*image, size_px);
}
void darken_texture(TexturedGarments& textured, double size_levels, const Placement& place) {
  if (cv::Mat* image = one_texture(textured, place)) add_levels(*image, -size_levels);
}
void shift_texture(TexturedGarments& textured, double size_px, const Placement& place) {
  if (cv::Mat* image = one_texture(textured, place)) shift_image(*image, static_cast<int>(size_px), 0);
}
void hole_in_texture(TexturedGarments& textured, double size_px, const Placement& place) {
  if (cv::Mat* image = one_texture(textured, place))
    square_hole(*image, static_cast<int>(size_px), cv::Scalar::all(255), place);
}
void swap_channels(TexturedGarments& textured, double, const Placement&) {
  for (auto& [slot, garment] : textured.garments)
    if (!garment.texture.empty()) cv::cvtColor(garment.texture.clone(), garment.texture, cv::COLOR_BGR2RGB);
}

}  // namespace

std::vector<Fault> garment_faults() {
  using Closed = ClosedGarments;
  using Opened = OpenGarments;
  using Textured = TexturedGarments;
  return {
      artifact_fault<Closed>("surface", "blown", "mm", {1, 4, 12}, "a closed garment too wide", blow_one<Closed>),
      artifact_fault<Closed>("surface", "noisy", "mm", {0.5, 2, 6}, "noise on a closed garment", shake_one<Closed>),
      artifact_fault<Closed>("surface", "shifted", "mm", {2, 8, 25}, "a closed garment moved", shift_one<Closed>),
      artifact_fault<Closed>("surface", "dented", "mm", {5, 15, 40}, "a dent of 16 cm", dent_closed),
      artifact_fault<Opened>("open", "scaled", "%", {0.5, 2, 6}, "an open garment too large", scale_one<Opened>),
      artifact_fault<Opened>("open", "shifted", "mm", {2, 8, 25}, "an open garment moved", shift_one<Opened>),
      artifact_fault<Opened>("open", "noisy", "mm", {0.5, 2, 6}, "noise on an open garment", shake_one<Opened>),
      artifact_fault<Opened>("open", "hole", "mm", {20, 50, 120}, "a round hole in an open garment", hole_in_open),
      artifact_fault<Opened>("open", "shortened", "mm", {5, 20, 60}, "an open garment shorter", shorten_open),
      artifact_fault<Textured>("texture", "blurred", "px", {0.7, 2, 8}, "a texture out of focus", blur_texture),
      artifact_fault<Textured>("texture", "darkened", "levels", {2, 8, 30}, "a texture darker", darken_texture),
      artifact_fault<Textured>("texture", "shifted", "px", {1, 4, 16}, "a texture beside its charts", shift_texture),
      artifact_fault<Textured>("texture", "hole", "px", {16, 48, 160}, "a white square in a texture", hole_in_texture),
      artifact_fault<Textured>("texture", "channels_swapped", "there", {1}, "red and blue exchanged", swap_channels),
      artifact_fault<Textured>("texture", "mesh_scaled", "%", {0.5, 2, 6}, "a textured garment too large",
                               scale_one<Textured>),
  };
}

}  // namespace dressform
