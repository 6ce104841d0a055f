#include "eval/score/mesh_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/metrics/mesh_distance.h"
#include "eval/metrics/sampling.h"
#include "scenes/error.h"
#include "scenes/mesh_frame.h"

namespace dressform {
namespace {

constexpr double kLeastSide_m = 0.1,
                 kMostSide_m = 3.0;                // the longest side of a child's shorts, of a person with arms up
constexpr double kMostArea_m2 = 15;                // a long coat of several layers has some 6
constexpr std::size_t kMostTriangles = 1'000'000;  // some twenty times a garment of the pipeline
constexpr double kSameSurface_m = 0.002;           // a .glb may be simplified a little, and is single precision
constexpr std::size_t kVerticesCompared = 20'000;  // of each, evenly spread

constexpr double kUsualLeast_m = 0.25, kUsualMost_m = 2.1;  // the longest side of shorts, of a person

// The largest distance from some of the vertices of one mesh to the triangles of the other.
double largest_distance(const Mesh& from, const metrics::MeshDistance& to) {
  std::vector<Vector3d> points;
  const std::size_t step = std::max<std::size_t>(1, from.vertices.size() / kVerticesCompared);
  for (std::size_t i = 0; i < from.vertices.size(); i += step) points.push_back(from.vertices[i]);
  double largest = 0;
  for (const auto& nearest : to.nearest(points)) largest = std::max(largest, nearest.distance_m);
  return largest;
}

}  // namespace

void check_mesh_bounds(const Mesh& mesh, const std::string& where, double usual_side_m) {
  if (mesh.triangles.size() > kMostTriangles)
    throw InputError(where, fmt::format("found {} triangles; expected at most {}: simplify it", mesh.triangles.size(),
                                        kMostTriangles));
  const Box box = bounding_box(mesh);
  const Vector3d sides = box.isEmpty() ? Vector3d::Zero() : Vector3d(box.sizes());
  const auto misfit = [&](const Box& other) {
    const double side = other.sizes().maxCoeff();
    return side < kUsualLeast_m || side > kUsualMost_m ? INFINITY : std::abs(std::log(side / usual_side_m));
  };
  if (const double side = sides.maxCoeff(); !(side >= kLeastSide_m && side <= kMostSide_m))
    throw InputError(where, fmt::format("found a mesh of {:.4g} x {:.4g} x {:.4g}; expected metres, the longest side "
                                        "of a person or garment from {:g} to {:g}{}",
                                        sides.x(), sides.y(), sides.z(), kLeastSide_m, kMostSide_m,
                                        side > 0 ? likely_frame(box, MeshFrame{}, misfit) : ""));
  const double area_m2 = metrics::surface_area(mesh);
  if (!(area_m2 <= kMostArea_m2))
    throw InputError(where, fmt::format("found a surface of {:.4g} square metres within {:.4g} x {:.4g} x {:.4g} m; "
                                        "expected at most {:g}: is it crumpled, or does it have many layers?",
                                        area_m2, sides.x(), sides.y(), sides.z(), kMostArea_m2));
}

void check_same_surface(const Mesh& mesh, const std::string& where, const Mesh& second, const std::string& other) {
  const double there = largest_distance(mesh, metrics::MeshDistance(second)),
               back = largest_distance(second, metrics::MeshDistance(mesh));
  if (std::max(there, back) <= kSameSurface_m) return;
  throw InputError(where,
                   fmt::format("contradicts {}: the two surfaces lie up to {:.1f} mm apart; expected one surface "
                               "within {:g} mm in both. Write both from the same mesh, or leave one out",
                               other, 1000 * std::max(there, back), 1000 * kSameSurface_m));
}

}  // namespace dressform
