#include "synthetic/garments/sewing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "fmt/format.h"
#include "scenes/error.h"
#include "synthetic/garments/drape/even_mesh.h"
#include "synthetic/garments/drape/fall.h"
#include "synthetic/garments/garment_shape.h"
#include "synthetic/geometry/contour.h"
#include "synthetic/geometry/self_intersection.h"
#include "synthetic/geometry/surface_distance.h"

namespace dressform {
namespace {

constexpr double kStep = 0.008;        // of the grid that the solid is sampled on, m
constexpr double kFineStep = 0.006;    // where the usual one does not do
constexpr double kClearance = 0.0045;  // of the cloth off the body, m
constexpr double kCollarEdge = 0.012;  // a collar does not lie round the neck in larger triangles, m
constexpr double kLayerGap = 0.0030;   // of cloth over cloth, m

using ShapeMaker = GarmentShape (*)(const GarmentSpec&, const Body&, const std::vector<Garment>&, Seed);

ShapeMaker maker_of(const std::string& kind) {
  if (kind == "shirt" || kind == "dress") return shirt_shape;
  if (kind == "trousers") return trousers_shape;
  if (kind == "skirt") return skirt_shape;
  throw InputError("garment.kind",
                   "found \"" + kind + "\" without a mesh; expected \"shirt\", \"dress\", \"trousers\" or \"skirt\"");
}

struct NamedLoop {
  std::string name;
  std::vector<int> vertices;
};

// Each boundary loop belongs to the cut on whose zero its points lie. The first cut's comes last: a collar may have
// been sewn to it.
std::vector<NamedLoop> name_rims(const Mesh& cut, const std::vector<RimCut>& cuts) {
  auto loops = boundary_loops(cut);
  std::vector<NamedLoop> rims(cuts.size());
  for (size_t i = cuts.size(); i-- > 0;) {
    const auto off = [&](const std::vector<int>& loop) {
      double sum = 0;
      for (int v : loop) sum += std::abs(cuts[i].beyond(cut.vertices[v])) / loop.size();
      return sum;
    };
    const auto best =
        std::min_element(loops.begin(), loops.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });
    rims[i] = {cuts[i].name, std::move(*best)};
    loops.erase(best);
  }
  return rims;
}

// One piece of genus 0 with exactly the openings that were cut.
bool cut_as_planned(const Mesh& mesh, size_t openings) {
  const Topology shape = topology(mesh);
  return shape.components == 1 && shape.non_manifold_edges == 0 && shape.loops == static_cast<int>(openings) &&
         shape.euler() == 2 - static_cast<int>(openings);
}

// On which side of each seam a triangle lies, as one number.
std::vector<int> sides_of_seams(const Mesh& mesh, const std::vector<Level>& seams) {
  std::vector<int> sides;
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d center = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    int side = 0;
    for (const Level& seam : seams) side = 2 * side + (seam(center) > 0);
    sides.push_back(side);
  }
  return sides;
}

Mesh joined(const std::vector<Garment>& garments) {
  Mesh all;
  for (const Garment& each : garments) {
    const Vector3i shift = Vector3i::Constant(static_cast<int>(all.vertices.size()));
    all.vertices.insert(all.vertices.end(), each.textured.mesh.vertices.begin(), each.textured.mesh.vertices.end());
    for (const Vector3i& t : each.textured.mesh.triangles) all.triangles.push_back(t + shift);
  }
  return all;
}

std::vector<std::vector<int>> neighbours_of(const Mesh& mesh) {
  std::vector<std::vector<int>> neighbours(mesh.vertices.size());
  std::vector<char> at_rim(mesh.vertices.size(), 0);
  const auto loops = boundary_loops(mesh);
  for (const auto& e : features_of(mesh.triangles).edges) {
    neighbours[e[0]].push_back(e[1]);
    neighbours[e[1]].push_back(e[0]);
  }
  for (const auto& loop : loops)  // a rim is smoothed along itself
    for (size_t i = 0; i < loop.size(); ++i)
      neighbours[loop[i]] = {loop[(i + 1) % loop.size()], loop[(i + loop.size() - 1) % loop.size()]};
  return neighbours;
}

// Evens out the cloth about some triangles: their vertices and two rings round them.
void smooth_about(Mesh& mesh, const std::vector<int>& triangles, const std::vector<std::vector<int>>& neighbours) {
  std::set<int> about;
  for (int t : triangles)
    for (int k = 0; k < 3; ++k) about.insert(mesh.triangles[t][k]);
  for (int ring = 0; ring < 2; ++ring) {
    std::set<int> wider = about;
    for (int i : about) wider.insert(neighbours[i].begin(), neighbours[i].end());
    about = std::move(wider);
  }
  for (int round = 0; round < 5; ++round) {
    const std::vector<Vector3d> before = mesh.vertices;
    for (int i : about) {
      Vector3d mean = Vector3d::Zero();
      for (int n : neighbours[i]) mean += before[n] / static_cast<double>(neighbours[i].size());
      mesh.vertices[i] = 0.5 * (before[i] + mean);
    }
  }
}

// The cloth moved off the body and off what is worn beneath, and evened out where it then meets itself or those;
// nothing where that does not help.
std::optional<Mesh> disentangled(Mesh mesh, const Body& body, const std::vector<Garment>& inner) {
  constexpr int kRounds = 12;
  const Mesh layer = joined(inner);
  const auto neighbours = neighbours_of(mesh);
  for (int round = 0; round < kRounds; ++round) {
    // Where there is no room for two layers at the full distance, less has to do.
    mesh = pushed_clear(mesh, body.mesh, kClearance * (1 - 0.5 * round / kRounds));
    for (const Garment& under : inner) mesh = pushed_clear(mesh, under.textured.mesh, kLayerGap);
    const std::vector<int> crossing = crossing_triangles(mesh, layer);
    if (crossing.empty()) return mesh;
    smooth_about(mesh, crossing, neighbours);
  }
  return std::nullopt;
}

// One way to make the closed shape's surface.
struct Contouring {
  Field solid;
  double step_m;
};

// As they are tried, one after the other.
std::vector<Contouring> contourings(const GarmentShape& shape) {
  const Field& parted = shape.parted ? shape.parted : shape.field;
  std::vector<Contouring> all{{shape.field, kStep}};
  if (shape.parted) all.push_back({parted, kStep});
  all.push_back({parted, kFineStep});
  return all;
}

// The cloth as it is put on, in triangles of `edge_m`; nothing where it does not come out in one piece or runs into
// itself or into what is worn beneath.
std::optional<Mesh> put_on(const Contouring& way, const GarmentShape& shape, const Body& body,
                           const std::vector<Garment>& inner, double edge_m) {
  std::optional<Mesh> solid = closed_contour(way.solid, shape.box, way.step_m);
  if (!solid) return std::nullopt;
  Mesh mesh = std::move(*solid);
  for (const RimCut& cut : shape.cuts) mesh = largest_part(cut_off(std::move(mesh), cut.beyond));
  if (!cut_as_planned(mesh, shape.cuts.size())) return std::nullopt;
  for (const Level& seam : shape.seams) split_along(mesh, seam);
  mesh = even_mesh(mesh, sides_of_seams(mesh, shape.seams), edge_m);
  if (!cut_as_planned(mesh, shape.cuts.size())) return std::nullopt;
  return disentangled(std::move(mesh), body, inner);
}

// With the collar, where there is one.
CollaredCloth sewn_together(const GarmentShape& shape, Mesh cloth, const Body& body, double edge_m) {
  if (shape.collar)
    return with_collar(cloth, name_rims(cloth, shape.cuts).front().vertices, *shape.collar, body, edge_m);
  CollaredCloth plain;
  plain.mesh = std::move(cloth);
  return plain;
}

Garment draped(const GarmentSpec& spec, const GarmentShape& shape, const CollaredCloth& sewn, const Body& body,
               const std::vector<Garment>& inner, Seed seed) {
  const Mesh& cut = sewn.mesh;
  const SurfaceDistance skin(body.mesh);
  const auto held = [&](const Vector3d& p) { return shape.held && shape.held(p) > 0; };
  DrapeParams params;
  params.bending_length_m = spec.bending_length_m;
  Cloth cloth = cloth_as_cut(cut, shape.fullness, held);
  if (!sewn.places.empty()) cloth.bending = sewn.bending(cloth.features);
  Wearer wearer{&skin, std::vector<double>(cut.vertices.size(), kClearance), joined(inner), 0};
  const ClothRest coarse = let_fall_first(cloth, wearer, params, seed);

  const Mesh fine_cut = subdivided(cut, cloth.features);
  Cloth fine = halved(cloth, cut, shape.fullness);
  wearer.clearance_m.assign(fine.mesh.vertices.size(), kClearance);
  params.seconds = 0.1;
  params.drag_per_s = 40;  // it lies already: what moves now comes from bending otherwise in smaller triangles
  params.step_s /= 2;
  params.grow_part = 0;
  params.ruffle_m = 0;
  Garment garment;
  garment.rest = let_fall_clear(fine, wearer, params, body.mesh, seed);
  garment.rest.settled &= coarse.settled;
  garment.rest.speed_m_per_s = std::max(garment.rest.speed_m_per_s, coarse.speed_m_per_s);
  std::vector<std::array<Vector2d, 3>> collar;
  for (const auto& corners : sewn.places)
    for (const auto& quarter : quartered(corners)) collar.push_back(quarter);
  garment.textured = textured_garment(fine_cut, shape, collar, spec.print, seed);
  garment.textured.mesh.vertices = fine.mesh.vertices;
  garment.rest_m = fine.rest_m;
  for (const NamedLoop& loop : name_rims(fine_cut, shape.cuts)) {
    TruthRim rim;
    rim.name = loop.name;
    for (int i : loop.vertices) rim.points.push_back(garment.textured.mesh.vertices[i]);
    garment.rims.push_back(std::move(rim));
  }
  return garment;
}

}  // namespace

Garment sewn_garment(const GarmentSpec& asked, const Body& body, const std::vector<Garment>& inner, Seed seed) {
  GarmentSpec spec = asked;
  if (spec.collar != "none" && spec.kind != "shirt" && spec.kind != "dress")
    throw InputError("garment.collar", "found it on a " + spec.kind + "; expected it on a shirt or a dress");
  if (spec.collar != "none" && spec.neck != "round")
    throw InputError("garment.neck", "found \"" + spec.neck + "\" under a " + spec.collar + "; expected \"round\"");
  if (spec.tucked && spec.kind != "shirt")
    throw InputError("garment.tucked", "found it on a " + spec.kind + "; expected it on a shirt");
  // Where wide cloth runs into itself (a sleeve into the hip), it is cut closer.
  for (const double part : {1.0, 0.6, 0.3, 0.0}) {
    spec.ease_m = part * asked.ease_m;
    const GarmentShape shape = maker_of(spec.kind)(spec, body, inner, seed);
    const double edge_m = 2 * (shape.collar ? std::min(spec.cloth_edge_m, kCollarEdge) : spec.cloth_edge_m);
    for (const Contouring& way : contourings(shape))
      if (auto cut = put_on(way, shape, body, inner, edge_m))
        return draped(spec, shape, sewn_together(shape, std::move(*cut), body, edge_m), body, inner, seed);
  }
  const bool top = spec.kind == "shirt" || spec.kind == "dress";
  throw InputError("garment." + asked.kind,
                   fmt::format("found cloth that runs into itself on this body; expected {}, or a smaller "
                               "garment.cloth_edge_m",
                               top ? "arms further off the trunk (body.arm_angle_deg), or a shorter garment.sleeve"
                                   : "legs further apart, or a shorter garment.length"));
}

}  // namespace dressform
