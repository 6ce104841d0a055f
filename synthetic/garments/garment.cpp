#include "synthetic/garments/garment.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "scenes/mesh_io.h"
#include "synthetic/garments/garment_shape.h"
#include "synthetic/geometry/contour.h"
#include "synthetic/geometry/surface_distance.h"

namespace dressform {
namespace {

constexpr double kStep = 0.008;  // edge of the cloth's triangles, m

using ShapeMaker = GarmentShape (*)(const GarmentSpec&, const Body&, const std::vector<Garment>&, Seed);

ShapeMaker maker_of(const std::string& kind) {
  if (kind == "shirt") return shirt_shape;
  if (kind == "trousers") return trousers_shape;
  if (kind == "skirt") return skirt_shape;
  throw InputError("garment.kind",
                   "found \"" + kind + "\" without a mesh; expected \"shirt\", \"trousers\" or \"skirt\"");
}

std::vector<Vector3d> loop_points(const Mesh& mesh, const std::vector<int>& loop) {
  std::vector<Vector3d> points;
  for (int i : loop) points.push_back(mesh.vertices[i]);
  return points;
}

// Each boundary loop belongs to the cut on whose zero its points lie.
std::vector<TruthRim> name_rims(const Mesh& mesh, const std::vector<RimCut>& cuts) {
  const auto loops = boundary_loops(mesh);
  if (loops.size() != cuts.size())
    throw std::runtime_error(fmt::format("garment: {} openings came out where {} were cut", loops.size(), cuts.size()));
  std::vector<TruthRim> rims;
  for (const RimCut& cut : cuts) {
    double best = 1e9;
    TruthRim rim;
    rim.name = cut.name;
    for (const auto& loop : loops) {
      double sum = 0;
      for (int i : loop) sum += std::abs(cut.beyond(mesh.vertices[i])) / loop.size();
      if (sum < best) {
        best = sum;
        rim.points = loop_points(mesh, loop);
      }
    }
    rims.push_back(std::move(rim));
  }
  return rims;
}

// One piece of genus 0 with exactly the openings that were cut.
bool cut_as_planned(const Mesh& mesh, size_t openings) {
  const Topology shape = topology(mesh);
  return shape.components == 1 && shape.non_manifold_edges == 0 && shape.loops == static_cast<int>(openings) &&
         shape.euler() == 2 - static_cast<int>(openings);
}

Mesh sew(const GarmentShape& shape, const Body& body, const std::vector<Garment>& inner) {
  Mesh mesh = contour(shape.field, shape.box, kStep);
  for (const RimCut& cut : shape.cuts) mesh = largest_part(cut_off(std::move(mesh), cut.beyond));
  mesh = pushed_clear(mesh, body.mesh, 0.0045);
  for (const Garment& under : inner) mesh = pushed_clear(mesh, under.textured.mesh, 0.0030);
  for (const Level& seam : shape.seams) split_along(mesh, seam);
  return mesh;
}

Garment procedural_garment(const GarmentSpec& asked, const Body& body, const std::vector<Garment>& inner, Seed seed) {
  GarmentSpec spec = asked;
  // Where wide cloth runs into itself (a sleeve into the hip), it is cut closer.
  for (const double part : {1.0, 0.6, 0.3, 0.0}) {
    spec.ease_m = part * asked.ease_m;
    spec.fold_amplitude_m = part * asked.fold_amplitude_m;
    const GarmentShape shape = maker_of(spec.kind)(spec, body, inner, seed);
    const Mesh mesh = sew(shape, body, inner);
    if (!cut_as_planned(mesh, shape.cuts.size())) continue;
    Garment garment;
    garment.rims = name_rims(mesh, shape.cuts);
    garment.textured = textured_garment(mesh, shape, spec.print, seed);
    return garment;
  }
  throw InputError("garment." + asked.kind,
                   "found cloth that runs into itself on this body; expected limbs that stand "
                   "clear of the trunk and of one another");
}

Vector3d mean_of(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// Names the openings of anyone's garment by where they are: the highest is the neck or the waist, the lowest the hem,
// those at the sides left and right.
std::vector<TruthRim> rims_by_position(const Mesh& mesh, const std::string& kind, const std::string& where) {
  std::vector<TruthRim> rims;
  for (const auto& loop : boundary_loops(mesh)) rims.push_back({"", 0, loop_points(mesh, loop)});
  if (rims.empty()) throw InputError(where, "found no opening; expected an open garment");
  std::stable_sort(rims.begin(), rims.end(),
                   [](const TruthRim& a, const TruthRim& b) { return mean_of(a.points).y() > mean_of(b.points).y(); });
  const bool top = kind == "shirt" || kind == "dress";
  double middle = 0;
  for (const Vector3d& v : mesh.vertices) middle += v.x() / mesh.vertices.size();
  int others = 0;
  for (size_t i = 0; i < rims.size(); ++i) {
    const double off = mean_of(rims[i].points).x() - middle;
    const bool at_side = std::abs(off) > 0.04;
    if (i == 0)
      rims[i].name = top ? "neck" : "waist";
    else if (at_side)
      rims[i].name = std::string(off > 0 ? "left_" : "right_") + (top ? "cuff" : "ankle");
    else
      rims[i].name = others++ == 0 ? "hem" : fmt::format("opening_{}", others);
  }
  return rims;
}

Garment garment_from_files(const GarmentSpec& spec) {
  Garment garment;
  garment.textured = read_textured_mesh(spec.mesh, spec.texture);
  garment.rims = rims_by_position(garment.textured.mesh, spec.kind, spec.mesh.string());
  return garment;
}

}  // namespace

Garment make_garment(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed) {
  return spec.mesh.empty() ? procedural_garment(spec, body, inner, seed) : garment_from_files(spec);
}

}  // namespace dressform
