#include "synthetic/garments/garment.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "scenes/mesh_io.h"
#include "synthetic/garments/sewing.h"

namespace dressform {
namespace {

std::vector<Vector3d> loop_points(const Mesh& mesh, const std::vector<int>& loop) {
  std::vector<Vector3d> points;
  for (int i : loop) points.push_back(mesh.vertices[i]);
  return points;
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
  return spec.mesh.empty() ? sewn_garment(spec, body, inner, seed) : garment_from_files(spec);
}

}  // namespace dressform
