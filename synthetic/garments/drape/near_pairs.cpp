#include "synthetic/garments/drape/near_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "scenes/triangle.h"

namespace dressform {
namespace {

using Eigen::Vector2i;

// Parameters of the closest points of two segments (Ericson, 5.1.9).
Eigen::Vector2d closest_in_segments(const Vector3d& p, const Vector3d& p_end, const Vector3d& q,
                                    const Vector3d& q_end) {
  const Vector3d d1 = p_end - p, d2 = q_end - q, r = p - q;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r), c = d1.dot(r), b = d1.dot(d2);
  const double denominator = a * e - b * b;
  double s = denominator > 1e-12 * a * e ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  double t = (b * s + f) / e;
  if (t < 0) {
    t = 0;
    s = std::clamp(-c / a, 0.0, 1.0);
  } else if (t > 1) {
    t = 1;
    s = std::clamp((b - c) / a, 0.0, 1.0);
  }
  return {s, t};
}

struct Box {
  Eigen::Array3d low, high;
  void add(const Vector3d& p) {
    low = low.min(p.array());
    high = high.max(p.array());
  }
  bool apart(const Box& other) const { return (low > other.high).any() || (other.low > high).any(); }
};

Box box_about(const Vector3d& p, double margin) { return {p.array() - margin, p.array() + margin}; }

// Features sorted into the cells of a dense grid that their boxes overlap.
class Cells {
 public:
  Cells(const Box& all, double edge) : low_(all.low), inverse_(1 / edge) {
    for (int k = 0; k < 3; ++k) size_[k] = std::max(1, static_cast<int>(std::ceil((all.high[k] - low_[k]) * inverse_)));
  }

  Eigen::Array3i cell(const Eigen::Array3d& at) const {
    Eigen::Array3i c = ((at - low_) * inverse_).floor().cast<int>();
    return c.max(0).min(size_ - 1);
  }
  int index(const Eigen::Array3i& c) const { return (c[2] * size_[1] + c[1]) * size_[0] + c[0]; }
  int count() const { return size_[0] * size_[1] * size_[2]; }

  // Boxes wholly outside of the grid belong to no cell.
  bool holds(const Box& box) const {
    const Eigen::Array3d high = low_ + size_.cast<double>() / inverse_;
    return (box.high >= low_).all() && (box.low <= high).all();
  }

  template <class Visit>
  void for_cells(const Box& box, const Visit& visit) const {
    if (!holds(box)) return;
    const Eigen::Array3i a = cell(box.low), b = cell(box.high);
    for (int z = a[2]; z <= b[2]; ++z)
      for (int y = a[1]; y <= b[1]; ++y)
        for (int x = a[0]; x <= b[0]; ++x) visit(index({x, y, z}));
  }

  // Of all cells that two boxes share, one is theirs.
  bool owns(int c, const Box& a, const Box& b) const { return index(cell(a.low.max(b.low))) == c; }

 private:
  Eigen::Array3d low_;
  double inverse_;
  Eigen::Array3i size_{1, 1, 1};
};

// The numbers of boxes by cell.
struct CellLists {
  std::vector<int> start, items;

  // Of boxes [first, last).
  CellLists(const Cells& cells, const std::vector<Box>& boxes, size_t first, size_t last) {
    start.assign(static_cast<size_t>(cells.count()) + 1, 0);
    for (size_t i = first; i < last; ++i) cells.for_cells(boxes[i], [&](int c) { ++start[c + 1]; });
    for (size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    items.resize(start.back());
    std::vector<int> next(start.begin(), start.end() - 1);
    for (size_t i = first; i < last; ++i)
      cells.for_cells(boxes[i], [&](int c) { items[next[c]++] = static_cast<int>(i); });
  }
};

class Finder {
 public:
  Finder(const std::vector<Vector3d>& x, const Features& features, int first_fixed, double reach)
      : x_(x), features_(features), first_fixed_(first_fixed), reach_(reach) {
    result_.room_m.assign(x.size(), reach);
  }

  NearResult run() {
    Box all = box_about(x_[0], 0);
    for (int i = 0; i < first_fixed_; ++i) all.add(x_[i]);
    all.low -= reach_;
    all.high += reach_;
    double length = 0;
    for (const Vector2i& e : features_.edges) length += (x_[e[0]] - x_[e[1]]).norm() / features_.edges.size();
    const Cells cells(all, length + reach_);
    vertices_against_triangles(cells);
    edges_against_edges(cells);
    return std::move(result_);
  }

 private:
  bool fixed(int i) const { return i >= first_fixed_; }

  // How many of the features move: they come first.
  template <class Feature>
  size_t moving(const std::vector<Feature>& all) const {
    return std::partition_point(all.begin(), all.end(), [&](const Feature& f) { return !fixed(f[0]); }) - all.begin();
  }

  template <class Feature>
  std::vector<Box> boxes_of(const std::vector<Feature>& all, double margin) const {
    std::vector<Box> boxes;
    boxes.reserve(all.size());
    for (const Feature& f : all) {
      Box box = box_about(x_[f[0]], 0);
      for (int k = 1; k < static_cast<int>(f.size()); ++k) box.add(x_[f[k]]);
      box.low -= margin;
      box.high += margin;
      boxes.push_back(box);
    }
    return boxes;
  }

  void vertices_against_triangles(const Cells& cells) {
    const std::vector<Box> boxes = boxes_of(features_.triangles, reach_);
    const size_t own = moving(features_.triangles);
    const CellLists cloth(cells, boxes, 0, own), layer(cells, boxes, own, boxes.size());
    for (int v = 0; v < static_cast<int>(x_.size()); ++v) {
      const Box at = box_about(x_[v], 0);
      if (!cells.holds(at)) continue;
      const int c = cells.index(cells.cell(at.low));
      const auto look = [&](const CellLists& lists) {
        for (int k = lists.start[c]; k < lists.start[c + 1]; ++k)
          if (!boxes[lists.items[k]].apart(at)) vertex_pair(v, features_.triangles[lists.items[k]]);
      };
      look(cloth);
      if (!fixed(v)) look(layer);
    }
  }

  void vertex_pair(int v, const Vector3i& t) {
    if (t[0] == v || t[1] == v || t[2] == v) return;
    const Vector3d w = closest_barycentric(x_[v], x_[t[0]], x_[t[1]], x_[t[2]]);
    keep({{v, t[0], t[1], t[2]}, {1, -w[0], -w[1], -w[2]}, {}, 0});
  }

  void edges_against_edges(const Cells& cells) {
    const std::vector<Box> boxes = boxes_of(features_.edges, 0.5 * reach_);
    const size_t own = moving(features_.edges);
    const CellLists cloth(cells, boxes, 0, own), layer(cells, boxes, own, boxes.size());
    for (int c = 0; c < cells.count(); ++c)
      for (int i = cloth.start[c]; i < cloth.start[c + 1]; ++i) {
        const int first = cloth.items[i];
        const auto meet = [&](int second) {
          if (boxes[first].apart(boxes[second]) || !cells.owns(c, boxes[first], boxes[second])) return;
          edge_pair(features_.edges[first], features_.edges[second]);
        };
        for (int k = i + 1; k < cloth.start[c + 1]; ++k) meet(cloth.items[k]);
        for (int k = layer.start[c]; k < layer.start[c + 1]; ++k) meet(layer.items[k]);
      }
  }

  void edge_pair(const Vector2i& a, const Vector2i& b) {
    if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) return;
    const Eigen::Vector2d at = closest_in_segments(x_[a[0]], x_[a[1]], x_[b[0]], x_[b[1]]);
    // Where an end is closest, a vertex and a triangle already are the pair.
    if (at.minCoeff() <= 0 || at.maxCoeff() >= 1) return;
    keep({{a[0], a[1], b[0], b[1]}, {1 - at[0], at[0], at[1] - 1, -at[1]}, {}, 0});
  }

  void keep(NearPair pair) {
    Vector3d gap = Vector3d::Zero();
    for (int k = 0; k < 4; ++k) gap += pair.weight[k] * x_[pair.vertex[k]];
    pair.gap_m = gap.norm();
    if (pair.gap_m >= reach_) return;
    for (int i : pair.vertex) result_.room_m[i] = std::min(result_.room_m[i], pair.gap_m);
    if (pair.gap_m < 1e-12) return;
    pair.normal = gap / pair.gap_m;
    result_.pairs.push_back(pair);
  }

  const std::vector<Vector3d>& x_;
  const Features& features_;
  int first_fixed_;
  double reach_;
  NearResult result_;
};

}  // namespace

Features features_of(const std::vector<Vector3i>& triangles) {
  Features features;
  features.triangles = triangles;
  std::vector<std::pair<int, int>> edges;
  for (const Vector3i& t : triangles)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [a, b] : edges) features.edges.emplace_back(a, b);
  return features;
}

NearResult near_pairs(const std::vector<Vector3d>& positions, const Features& features, int first_fixed,
                      double reach_m) {
  return Finder(positions, features, first_fixed, reach_m).run();
}

}  // namespace dressform
