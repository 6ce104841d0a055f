#include "pipeline/body/sections.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

namespace dressform {
namespace {

constexpr double kSmallestArea_m2 = 4e-4;  // smaller loops are fingers and crumbs

using EdgeKey = std::pair<int, int>;

struct Segment {
  EdgeKey from, to;
};

Vector3d crossing(const Mesh& mesh, const EdgeKey& edge, double y) {
  const Vector3d &a = mesh.vertices[edge.first], &b = mesh.vertices[edge.second];
  const double t = (y - a.y()) / (b.y() - a.y());
  Vector3d point = a + t * (b - a);
  point.y() = y;
  return point;
}

// The segment of a triangle in the plane, its inside to the left seen from below. Vertices on the plane count as above.
bool cut_triangle(const Mesh& mesh, const Vector3i& t, double y, Segment& segment) {
  bool above[3];
  for (int k = 0; k < 3; ++k) above[k] = mesh.vertices[t[k]].y() >= y;
  if (above[0] == above[1] && above[1] == above[2]) return false;
  for (int k = 0; k < 3; ++k) {
    const int a = t[k], b = t[(k + 1) % 3];
    if (above[k] == above[(k + 1) % 3]) continue;
    (above[k] ? segment.to : segment.from) = std::minmax(a, b);
  }
  return true;
}

void finish(SectionLoop& loop) {
  double area = 0;
  Vector3d sum = Vector3d::Zero();
  const Vector3d origin = loop.points.front();
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vector3d a = loop.points[i] - origin, b = loop.points[(i + 1) % loop.points.size()] - origin;
    const double cross = a.x() * b.z() - a.z() * b.x();
    area += cross;
    sum += cross * (a + b);
  }
  loop.area_m2 = area / 2;
  loop.centroid = std::abs(area) > 1e-12 ? Vector3d(origin + sum / (3 * area)) : origin;
  loop.centroid.y() = origin.y();
}

std::vector<SectionLoop> chain(const Mesh& mesh, const std::vector<Segment>& segments, double y) {
  std::map<EdgeKey, EdgeKey> next;
  for (const Segment& segment : segments) next.emplace(segment.from, segment.to);
  std::vector<SectionLoop> loops;
  while (!next.empty()) {
    SectionLoop loop;
    const EdgeKey start = next.begin()->first;
    auto at = next.begin();
    while (at != next.end()) {
      loop.points.push_back(crossing(mesh, at->first, y));
      const EdgeKey to = at->second;
      next.erase(at);
      if (to == start) break;
      at = next.find(to);
    }
    if (loop.points.size() < 3) continue;
    finish(loop);
    if (loop.area_m2 > kSmallestArea_m2) loops.push_back(std::move(loop));
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const SectionLoop& a, const SectionLoop& b) { return a.area_m2 > b.area_m2; });
  return loops;
}

}  // namespace

int Sections::level(double height) const {
  if (levels.empty()) return -1;
  return std::clamp(static_cast<int>(std::lround((height - first_y) / step)), 0, static_cast<int>(levels.size()) - 1);
}

Sections horizontal_sections(const Mesh& mesh, double step_m) {
  Sections sections;
  sections.step = step_m;
  if (mesh.triangles.empty()) return sections;
  double low = mesh.vertices[mesh.triangles[0][0]].y(), high = low;
  for (const Vector3i& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      low = std::min(low, mesh.vertices[t[k]].y());
      high = std::max(high, mesh.vertices[t[k]].y());
    }
  sections.first_y = low + step_m / 2;
  const int count = std::max(0, static_cast<int>(std::floor((high - sections.first_y) / step_m)) + 1);
  std::vector<std::vector<Segment>> segments(count);
  for (const Vector3i& t : mesh.triangles) {
    const double a = mesh.vertices[t[0]].y(), b = mesh.vertices[t[1]].y(), c = mesh.vertices[t[2]].y();
    const int from = std::max(0, static_cast<int>(std::floor((std::min({a, b, c}) - sections.first_y) / step_m)));
    const int to = std::min(count - 1, static_cast<int>(std::ceil((std::max({a, b, c}) - sections.first_y) / step_m)));
    for (int level = from; level <= to; ++level) {
      Segment segment;
      if (cut_triangle(mesh, t, sections.y(level), segment)) segments[level].push_back(segment);
    }
  }
  for (int level = 0; level < count; ++level)
    sections.levels.push_back(chain(mesh, segments[level], sections.y(level)));
  return sections;
}

bool contains(const SectionLoop& loop, const Vector3d& point) {
  bool inside = false;
  for (std::size_t i = 0, j = loop.points.size() - 1; i < loop.points.size(); j = i++) {
    const Vector3d &a = loop.points[i], &b = loop.points[j];
    if ((a.z() > point.z()) != (b.z() > point.z()) &&
        point.x() < (b.x() - a.x()) * (point.z() - a.z()) / (b.z() - a.z()) + a.x())
      inside = !inside;
  }
  return inside;
}

double tape_girth(const SectionLoop& loop) {
  std::vector<cv::Point2f> points, hull;
  for (const auto& p : loop.points) points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.z()));
  cv::convexHull(points, hull);
  return cv::arcLength(hull, true);
}

}  // namespace dressform
