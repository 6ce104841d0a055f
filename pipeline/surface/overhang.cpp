#include "pipeline/surface/overhang.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace dressform {
namespace {

constexpr double kHangs_m = 0.008;  // folds of skin, and what noise makes of a scanned body, are less

using Neighbours = std::vector<std::vector<int>>;

Neighbours neighbours_of(const Mesh& body) {
  Neighbours result(body.vertices.size());
  for (const Vector3i& t : body.triangles)
    for (int k = 0; k < 3; ++k) {
      result[t[k]].push_back(t[(k + 1) % 3]);
      result[t[k]].push_back(t[(k + 2) % 3]);
    }
  return result;
}

// How high one has to climb at least on the way to each vertex over the surface, from those that are `firm`: the
// minimax path (Dijkstra's algorithm with the maximum in place of the sum).
std::vector<double> climbs(const Mesh& body, const Neighbours& neighbours, const std::vector<char>& firm) {
  std::vector<double> climb(body.vertices.size(), std::numeric_limits<double>::infinity());
  using Place = std::pair<double, int>;
  std::priority_queue<Place, std::vector<Place>, std::greater<>> open;
  const auto reach = [&](int vertex, double from) {
    const double height = std::max(from, body.vertices[vertex].y());
    if (height >= climb[vertex]) return;
    climb[vertex] = height;
    open.emplace(height, vertex);
  };
  for (std::size_t v = 0; v < firm.size(); ++v)
    if (firm[v]) reach(static_cast<int>(v), -std::numeric_limits<double>::infinity());
  while (!open.empty()) {
    const auto [height, at] = open.top();
    open.pop();
    if (height > climb[at]) continue;
    for (const int next : neighbours[at]) reach(next, height);
  }
  return climb;
}

// What can be reached from the firm vertices over those that do not hang.
std::vector<char> borne(const Neighbours& neighbours, const std::vector<char>& firm, const std::vector<char>& hangs) {
  std::vector<char> reached = firm;
  std::vector<int> open;
  for (std::size_t v = 0; v < firm.size(); ++v)
    if (firm[v]) open.push_back(static_cast<int>(v));
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    for (const int next : neighbours[at]) {
      if (reached[next] || hangs[next]) continue;
      reached[next] = 1;
      open.push_back(next);
    }
  }
  return reached;
}

}  // namespace

std::vector<char> overhanging(const Mesh& body, const Landmarks& landmarks) {
  std::vector<char> firm(body.vertices.size(), 0), hangs(body.vertices.size(), 0);
  for (std::size_t i = 0; i < body.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int v = body.triangles[i][k];
      firm[v] |= landmarks.part_of(static_cast<int>(i)) != BodyPart::torso || body.vertices[v].y() < landmarks.armpit_y;
    }
  const Neighbours neighbours = neighbours_of(body);
  const std::vector<double> climb = climbs(body, neighbours, firm);
  for (std::size_t v = 0; v < hangs.size(); ++v) hangs[v] = climb[v] - body.vertices[v].y() > kHangs_m;
  const std::vector<char> reached = borne(neighbours, firm, hangs);
  std::vector<char> result(body.triangles.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Vector3i& t = body.triangles[i];
    result[i] = !(reached[t[0]] && reached[t[1]] && reached[t[2]]);
  }
  return result;
}

}  // namespace dressform
