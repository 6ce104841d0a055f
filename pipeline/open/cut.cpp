#include "pipeline/open/cut.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace dressform {
namespace {

using Graph = std::vector<std::vector<int>>;

Graph vertex_graph(const Mesh& mesh) {
  Graph graph(mesh.vertices.size());
  for (const Vector3i& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      graph[t[k]].push_back(t[(k + 1) % 3]);
      graph[t[(k + 1) % 3]].push_back(t[k]);
    }
  for (auto& each : graph) {
    std::sort(each.begin(), each.end());
    each.erase(std::unique(each.begin(), each.end()), each.end());
  }
  return graph;
}

template <class Member>
std::vector<int> piece_around(const Graph& graph, int start, std::vector<char>& seen, Member&& member) {
  std::vector<int> piece{start};
  seen[start] = 1;
  for (std::size_t i = 0; i < piece.size(); ++i)
    for (const int next : graph[piece[i]])
      if (!seen[next] && member(next)) {
        seen[next] = 1;
        piece.push_back(next);
      }
  return piece;
}

// For every vertex the cap it belongs to, -1 for the garment. Enclosed islands go to the cap around them.
std::vector<int> assign(const Graph& graph, const std::vector<Cap>& caps) {
  const int count = static_cast<int>(graph.size());
  std::vector<int> owner(count, -1);
  for (std::size_t c = 0; c < caps.size(); ++c) {
    const Cap& cap = caps[c];
    if (cap.pole < 0 || cap.beyond[cap.pole] <= 0 || owner[cap.pole] >= 0) return {};
    std::vector<char> seen(count, 0);
    const auto member = [&](int v) { return cap.beyond[v] > 0 && owner[v] < 0; };
    for (const int v : piece_around(graph, cap.pole, seen, member)) owner[v] = static_cast<int>(c);
    // All but the largest piece of the rest is enclosed by caps.
    std::vector<char> rest(count, 0);
    std::vector<std::vector<int>> pieces;
    for (int v = 0; v < count; ++v)
      if (owner[v] < 0 && !rest[v] && !graph[v].empty())
        pieces.push_back(piece_around(graph, v, rest, [&](int w) { return owner[w] < 0; }));
    if (pieces.empty()) return {};
    const auto largest = std::max_element(pieces.begin(), pieces.end(),
                                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    for (auto piece = pieces.begin(); piece != pieces.end(); ++piece)
      if (piece != largest)
        for (const int v : *piece) owner[v] = static_cast<int>(c);
  }
  return owner;
}

class Splitter {
 public:
  Splitter(const Mesh& closed, const std::vector<Cap>& caps, const std::vector<int>& owner)
      : closed_(closed), caps_(caps), owner_(owner), number_(closed.vertices.size(), -1) {}

  CutResult run() {
    for (const Vector3i& t : closed_.triangles) {
      int kept = 0;
      for (int k = 0; k < 3; ++k) kept += owner_[t[k]] < 0;
      if (kept == 3) add(keep(t[0]), keep(t[1]), keep(t[2]));
      if (kept == 0 || kept == 3) continue;
      int k = 0;  // the corner that is alone on its side
      while ((owner_[t[k]] < 0) != (kept == 1)) ++k;
      const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      if (kept == 1) {
        add(keep(a), crossing(a, b), crossing(a, c));
      } else {
        const int ab = crossing(b, a), ac = crossing(c, a);
        add(ab, keep(b), keep(c));
        add(ab, keep(c), ac);
      }
    }
    return std::move(result_);
  }

 private:
  void add(int a, int b, int c) { result_.mesh.triangles.emplace_back(a, b, c); }

  int keep(int v) {
    if (number_[v] < 0) {
      number_[v] = static_cast<int>(result_.mesh.vertices.size());
      result_.mesh.vertices.push_back(closed_.vertices[v]);
      result_.cap_of_vertex.push_back(-1);
    }
    return number_[v];
  }

  int crossing(int kept, int removed) {
    const auto found =
        crossings_.emplace(std::make_pair(kept, removed), static_cast<int>(result_.mesh.vertices.size()));
    if (!found.second) return found.first->second;
    const std::vector<double>& beyond = caps_[owner_[removed]].beyond;
    const double a = beyond[kept], b = beyond[removed];
    // An island that was added to the cap has no crossing of its own: half way.
    const double t = a <= 0 && b > 0 ? std::clamp(a / (a - b), 0.01, 0.99) : 0.5;
    result_.mesh.vertices.push_back(closed_.vertices[kept] + t * (closed_.vertices[removed] - closed_.vertices[kept]));
    result_.cap_of_vertex.push_back(owner_[removed]);
    return found.first->second;
  }

  const Mesh& closed_;
  const std::vector<Cap>& caps_;
  const std::vector<int>& owner_;
  std::vector<int> number_;
  std::map<std::pair<int, int>, int> crossings_;
  CutResult result_;
};

}  // namespace

CutResult cut_caps(const Mesh& closed, const std::vector<Cap>& caps) {
  const std::vector<int> owner = assign(vertex_graph(closed), caps);
  if (owner.empty()) return {};
  return Splitter(closed, caps, owner).run();
}

}  // namespace dressform
