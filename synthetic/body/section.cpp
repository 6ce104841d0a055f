#include "synthetic/body/section.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "synthetic/body/body.h"

namespace dressform {
namespace {

// A cut edge is named by its two vertices.
std::uint64_t edge_key(int a, int b) {
  const auto low = static_cast<std::uint64_t>(std::min(a, b)), high = static_cast<std::uint64_t>(std::max(a, b));
  return low << 32 | high;
}

// Cut points, and the neighbours of each along the curve (-1: none).
struct CutGraph {
  std::vector<Vector3d> points;
  std::vector<std::array<int, 2>> links;
};

CutGraph cut_triangles(const Mesh& mesh, const Vector3d& origin, const Vector3d& normal) {
  CutGraph graph;
  std::unordered_map<std::uint64_t, int> index;
  std::vector<double> height(mesh.vertices.size());
  for (size_t i = 0; i < height.size(); ++i) {
    const double d = (mesh.vertices[i] - origin).dot(normal);
    height[i] = d == 0 ? 1e-12 : d;  // a vertex on the plane counts as above it
  }
  const auto cut = [&](int a, int b) {
    const auto [found, is_new] = index.emplace(edge_key(a, b), static_cast<int>(graph.points.size()));
    if (is_new) {
      if (a > b) std::swap(a, b);
      const double t = height[a] / (height[a] - height[b]);
      graph.points.push_back(mesh.vertices[a] + t * (mesh.vertices[b] - mesh.vertices[a]));
      graph.links.push_back({-1, -1});
    }
    return found->second;
  };
  const auto link = [&](int from, int to) { graph.links[from][graph.links[from][0] < 0 ? 0 : 1] = to; };
  for (const Vector3i& t : mesh.triangles) {
    std::vector<int> ends;
    for (int k = 0; k < 3; ++k)
      if ((height[t[k]] < 0) != (height[t[(k + 1) % 3]] < 0)) ends.push_back(cut(t[k], t[(k + 1) % 3]));
    if (ends.size() != 2) continue;
    link(ends[0], ends[1]);
    link(ends[1], ends[0]);
  }
  return graph;
}

SectionCurve walk(const CutGraph& graph, int start, std::vector<char>& used) {
  SectionCurve curve;
  int previous = -1, current = start;
  while (current >= 0 && !used[current]) {
    used[current] = 1;
    curve.points.push_back(graph.points[current]);
    const auto& next = graph.links[current];
    const int ahead = next[0] != previous ? next[0] : next[1];
    previous = current;
    current = ahead;
  }
  curve.closed = current == start;
  return curve;
}

double curve_length(const SectionCurve& curve) {
  double sum = 0;
  for (size_t i = 1; i < curve.points.size(); ++i) sum += (curve.points[i] - curve.points[i - 1]).norm();
  return sum;
}

Polygon make_polygon(const SectionCurve& curve) {
  Polygon polygon;
  double twice = 0;
  Vector2d moment(0, 0), mean(0, 0);
  for (const Vector3d& p : curve.points) polygon.points.emplace_back(p.x(), p.z());
  for (const Vector2d& p : polygon.points) mean += p / static_cast<double>(polygon.points.size());
  for (size_t i = 0; i < polygon.points.size(); ++i) {
    const Vector2d a = polygon.points[i] - mean, b = polygon.points[(i + 1) % polygon.points.size()] - mean;
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice += cross;
    moment += cross * (a + b);
  }
  polygon.area = std::abs(twice) / 2;
  polygon.centroid = std::abs(twice) > 1e-12 ? Vector2d(mean + moment / (3 * twice)) : mean;
  return polygon;
}

}  // namespace

std::vector<SectionCurve> plane_section(const Mesh& mesh, const Vector3d& origin, const Vector3d& normal) {
  const CutGraph graph = cut_triangles(mesh, origin, normal);
  std::vector<char> used(graph.points.size(), 0);
  std::vector<SectionCurve> curves;
  // Open curves are walked from an end.
  for (size_t i = 0; i < graph.points.size(); ++i)
    if (!used[i] && graph.links[i][1] < 0) curves.push_back(walk(graph, static_cast<int>(i), used));
  for (size_t i = 0; i < graph.points.size(); ++i)
    if (!used[i]) curves.push_back(walk(graph, static_cast<int>(i), used));
  std::stable_sort(curves.begin(), curves.end(),
                   [](const auto& a, const auto& b) { return curve_length(a) > curve_length(b); });
  return curves;
}

std::vector<Polygon> horizontal_section(const Mesh& mesh, double y) {
  std::vector<Polygon> polygons;
  for (const SectionCurve& curve : plane_section(mesh, Vector3d(0, y, 0), Vector3d::UnitY()))
    if (curve.points.size() >= 3) polygons.push_back(make_polygon(curve));
  std::stable_sort(polygons.begin(), polygons.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  return polygons;
}

std::vector<Polygon> torso_part(const std::vector<Polygon>& polygons) {
  if (polygons.empty()) return {};
  std::vector<Polygon> result{polygons[0]};
  // A second section of about the same size is the other leg; an arm beside the torso is far smaller.
  if (polygons.size() > 1 && polygons[1].area > 0.7 * polygons[0].area) result.push_back(polygons[1]);
  return result;
}

std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  if (points.size() < 3) return points;
  const auto turns_left = [](const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) > 0;
  };
  std::vector<Vector2d> hull;
  const auto chain = [&](auto begin, auto end) {
    const size_t base = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= base + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *it)) hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

bool goes_round_origin(const std::vector<Vector2d>& polygon) {
  bool odd = false;
  for (size_t i = 0, n = polygon.size(); i < n; ++i) {
    const Vector2d &a = polygon[i], &b = polygon[(i + 1) % n];
    if ((a.y() > 0) != (b.y() > 0) && a.x() + (b.x() - a.x()) * a.y() / (a.y() - b.y()) > 0) odd = !odd;
  }
  return odd;
}

double polygon_length(const std::vector<Vector2d>& closed) {
  double sum = 0;
  for (size_t i = 0; i < closed.size(); ++i) sum += (closed[(i + 1) % closed.size()] - closed[i]).norm();
  return sum;
}

double tape_girth(const Mesh& body, double y) {
  std::vector<Vector2d> points;
  for (const Polygon& polygon : torso_part(horizontal_section(body, y)))
    points.insert(points.end(), polygon.points.begin(), polygon.points.end());
  return polygon_length(convex_hull(std::move(points)));
}

}  // namespace dressform
