#include "pipeline/geometry/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace dressform {
namespace {

using Offset = std::array<int, 3>;

// The 14 neighbours: 1-7 of 0/1 coordinates, then their opposites.
std::array<Offset, 14> make_neighbours() {
  std::array<Offset, 14> result{};
  for (int i = 1; i < 8; ++i) {
    result[i - 1] = {i & 1, (i >> 1) & 1, (i >> 2) & 1};
    result[i + 6] = {-(i & 1), -((i >> 1) & 1), -((i >> 2) & 1)};
  }
  return result;
}
const std::array<Offset, 14>& neighbours() {
  static const auto table = make_neighbours();
  return table;
}

bool is_neighbour(const Offset& d) {
  const int low = std::min({d[0], d[1], d[2]}), high = std::max({d[0], d[1], d[2]});
  return (low == 0 && high == 1) || (low == -1 && high == 0);
}

int link_components(unsigned members, const std::array<unsigned, 14>& adjacency) {
  int components = 0;
  while (members) {
    ++components;
    unsigned front = members & (~members + 1);
    while (front) {
      members &= ~front;
      unsigned next = 0;
      for (int i = 0; i < 14; ++i)
        if (front >> i & 1) next |= adjacency[i];
      front = next & members;
    }
  }
  return components;
}

// For every set of inside neighbours: whether the point in the middle may change sides. Its link is a sphere cut into
// triangles, so it is enough that the inside and the outside part are each one piece.
std::vector<bool> make_simple_table() {
  std::array<unsigned, 14> adjacency{};
  for (int i = 0; i < 14; ++i)
    for (int j = 0; j < 14; ++j) {
      const Offset &a = neighbours()[i], &b = neighbours()[j];
      if (i != j && is_neighbour({b[0] - a[0], b[1] - a[1], b[2] - a[2]})) adjacency[i] |= 1u << j;
    }
  std::vector<bool> simple(1 << 14);
  for (unsigned set = 0; set < simple.size(); ++set)
    simple[set] = link_components(set, adjacency) == 1 && link_components(~set & 0x3fffu, adjacency) == 1;
  return simple;
}
const std::vector<bool>& simple_table() {
  static const auto table = make_simple_table();
  return table;
}

std::array<std::ptrdiff_t, 14> strides(const Lattice& lattice) {
  std::array<std::ptrdiff_t, 14> result{};
  for (int i = 0; i < 14; ++i) {
    const Offset& d = neighbours()[i];
    result[i] = d[0] + static_cast<std::ptrdiff_t>(lattice.size[0]) *
                           (d[1] + static_cast<std::ptrdiff_t>(lattice.size[1]) * d[2]);
  }
  return result;
}

void clear_border(const Lattice& lattice, std::vector<float>& field) {
  const float outside = static_cast<float>(lattice.step_m);
  for (int z = 0; z < lattice.size[2]; ++z)
    for (int y = 0; y < lattice.size[1]; ++y) {
      const bool row = z == 0 || y == 0 || z == lattice.size[2] - 1 || y == lattice.size[1] - 1;
      for (int x = 0; x < lattice.size[0]; x += row ? 1 : std::max(1, lattice.size[0] - 1)) {
        float& value = field[lattice.index(x, y, z)];
        value = std::max(value, outside);
      }
    }
}

// Hollows: outside points that the lattice's corner cannot reach through outside points.
int fill_hollows(const Lattice& lattice, std::vector<float>& field) {
  std::vector<std::uint8_t> reached(field.size(), 0);
  std::vector<std::size_t> stack{0};
  const auto step = strides(lattice);
  reached[0] = 1;
  while (!stack.empty()) {
    const std::size_t at = stack.back();
    stack.pop_back();
    const auto [x, y, z] = lattice.cell(at);
    for (int i = 0; i < 14; ++i) {
      const Offset& d = neighbours()[i];
      const int nx = x + d[0], ny = y + d[1], nz = z + d[2];
      if (nx < 0 || ny < 0 || nz < 0 || nx >= lattice.size[0] || ny >= lattice.size[1] || nz >= lattice.size[2])
        continue;
      const std::size_t next = at + step[i];
      if (reached[next] || field[next] < 0) continue;
      reached[next] = 1;
      stack.push_back(next);
    }
  }
  int filled = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (field[i] < 0 || reached[i]) continue;
    field[i] = -static_cast<float>(0.1 * lattice.step_m);
    ++filled;
  }
  return filled;
}

// How deep every inside point lies below the outside, in steps, by a two-pass chamfer transform; 0 outside. Growing by
// this and not by the field keeps the front smooth where the field jumps.
std::vector<float> depth_below(const Lattice& lattice, const std::vector<float>& field) {
  std::vector<float> depth(field.size());
  for (std::size_t i = 0; i < field.size(); ++i) depth[i] = field[i] < 0 ? 1e6f : 0.0f;
  const auto visit = [&](int x, int y, int z, int sign) {
    const std::size_t at = lattice.index(x, y, z);
    if (depth[at] == 0) return;
    for (int dz = -1; dz <= 0; ++dz)
      for (int dy = -1; dy <= (dz ? 1 : 0); ++dy)
        for (int dx = -1; dx <= (dz || dy ? 1 : -1); ++dx) {
          const float length = std::sqrt(static_cast<float>(dx * dx + dy * dy + dz * dz));
          depth[at] = std::min(depth[at], depth[lattice.index(x + sign * dx, y + sign * dy, z + sign * dz)] + length);
        }
  };
  for (int z = 1; z + 1 < lattice.size[2]; ++z)
    for (int y = 1; y + 1 < lattice.size[1]; ++y)
      for (int x = 1; x + 1 < lattice.size[0]; ++x) visit(x, y, z, 1);
  for (int z = lattice.size[2] - 2; z > 0; --z)
    for (int y = lattice.size[1] - 2; y > 0; --y)
      for (int x = lattice.size[0] - 2; x > 0; --x) visit(x, y, z, -1);
  return depth;
}

// The largest piece of the points deeper than `least`.
std::vector<std::uint8_t> largest_piece(const Lattice& lattice, const std::vector<float>& depth, float least) {
  const auto step = strides(lattice);
  std::vector<int> piece(depth.size(), 0);
  int pieces = 0, largest = 0;
  std::size_t most = 0;
  std::vector<std::size_t> stack;
  for (std::size_t start = 0; start < depth.size(); ++start) {
    if (piece[start] || depth[start] <= least) continue;
    piece[start] = ++pieces;
    stack.assign(1, start);
    std::size_t size = 0;
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      ++size;
      for (const std::ptrdiff_t d : step) {
        if (piece[at + d] || depth[at + d] <= least) continue;
        piece[at + d] = pieces;
        stack.push_back(at + d);
      }
    }
    if (size <= most) continue;
    most = size;
    largest = pieces;
  }
  std::vector<std::uint8_t> taken(depth.size(), 0);
  for (std::size_t i = 0; i < depth.size(); ++i) taken[i] = largest > 0 && piece[i] == largest;
  return taken;
}

// Euler characteristic of the points taken and all that lies between them: 1 for a ball, less by one for a handle, more
// by one for a hollow.
int euler(const Lattice& lattice, const std::vector<std::uint8_t>& taken) {
  const auto step = strides(lattice);
  long sum = 0;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (!taken[i]) continue;  // counts each simplex at its lowest corner
    ++sum;
    for (int a = 1; a < 8; ++a) {
      if (!taken[i + step[a - 1]]) continue;
      --sum;
      for (int b = a + 1; b < 8; ++b) {
        if ((a & b) != a || !taken[i + step[b - 1]]) continue;
        ++sum;
        for (int c = b + 1; c < 8; ++c)
          if ((b & c) == b && taken[i + step[c - 1]]) --sum;
      }
    }
  }
  return static_cast<int>(sum);
}

// Adds the inside points that change no topology, deepest first, until none is left.
void grow(const Lattice& lattice, const std::vector<float>& depth, std::vector<std::uint8_t>& taken) {
  const auto step = strides(lattice);
  const auto& simple = simple_table();
  using Item = std::pair<float, std::size_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<Item>> front;
  std::vector<std::uint8_t> waiting(depth.size(), 0);
  const auto offer_neighbours = [&](std::size_t at) {
    for (const std::ptrdiff_t d : step) {
      const std::size_t next = at + d;
      if (taken[next] || waiting[next] || depth[next] <= 0) continue;
      waiting[next] = 1;
      front.push({-depth[next], next});
    }
  };
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (taken[i]) offer_neighbours(i);
  while (!front.empty()) {
    const std::size_t at = front.top().second;
    front.pop();
    waiting[at] = 0;  // a neighbour taken later brings it back
    unsigned set = 0;
    for (int i = 0; i < 14; ++i) set |= static_cast<unsigned>(taken[at + step[i]]) << i;
    if (!simple[set]) continue;
    taken[at] = 1;
    offer_neighbours(at);
  }
}

// The inside points that make a ball. Mostly they do already; where they do not, a ball is looked for by taking off
// layers, which opens what only touches, and is grown back. The last resort is to grow from the deepest point.
std::vector<std::uint8_t> ball_of(const Lattice& lattice, const std::vector<float>& field) {
  const std::vector<float> depth = depth_below(lattice, field);
  std::vector<std::uint8_t> taken;
  for (float least = 0; least < 16; least += 1) {
    taken = largest_piece(lattice, depth, least);
    if (euler(lattice, taken) != 1) continue;
    if (least > 0) grow(lattice, depth, taken);
    return taken;
  }
  taken.assign(depth.size(), 0);
  taken[std::max_element(depth.begin(), depth.end()) - depth.begin()] = 1;
  grow(lattice, depth, taken);
  return taken;
}

struct SurfaceBuilder {
  const Lattice& lattice;
  const std::vector<float>& field;
  std::array<std::ptrdiff_t, 14> step;
  std::vector<std::array<int, 7>> rows;  // vertex numbers of the edges from the points of two slabs
  Mesh mesh;

  SurfaceBuilder(const Lattice& l, const std::vector<float>& f) : lattice(l), field(f), step(strides(l)) {
    rows.assign(2 * static_cast<std::size_t>(l.size[0]) * l.size[1], empty_row());
  }
  static std::array<int, 7> empty_row() { return {-1, -1, -1, -1, -1, -1, -1}; }

  // The crossing on the edge from point a to its neighbour b = a + offset of bits (b > a).
  int vertex(std::size_t a, std::size_t b) {
    if (a > b) std::swap(a, b);
    const auto found = std::find(step.begin(), step.begin() + 7, static_cast<std::ptrdiff_t>(b - a));
    int& number = rows[a % rows.size()][found - step.begin()];
    if (number >= 0) return number;
    const double fa = field[a], fb = field[b];
    const double t = std::clamp(fa / (fa - fb), 0.02, 0.98);
    number = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(lattice.point(a) + t * (lattice.point(b) - lattice.point(a)));
    return number;
  }

  void add(int a, int b, int c, bool flip) { mesh.triangles.push_back(flip ? Vector3i(a, c, b) : Vector3i(a, b, c)); }

  // p: four points of a tetrahedron of positive volume.
  void tetrahedron(const std::array<std::size_t, 4>& p, bool mirrored) {
    int in[4], out[4], inside = 0, outside = 0;
    for (int k = 0; k < 4; ++k) (field[p[k]] < 0 ? in[inside++] : out[outside++]) = k;
    if (inside == 0 || inside == 4) return;
    if (inside == 1 || inside == 3) {
      const int apex = inside == 1 ? in[0] : out[0];
      const int* others = inside == 1 ? out : in;
      // Seen from the apex, the other three in their order turn clockwise for an even place of the apex.
      const bool flip = (apex % 2 == 0) != (inside == 1);
      add(vertex(p[apex], p[others[0]]), vertex(p[apex], p[others[1]]), vertex(p[apex], p[others[2]]),
          flip != mirrored);
      return;
    }
    const int v00 = vertex(p[in[0]], p[out[0]]), v01 = vertex(p[in[0]], p[out[1]]);
    const int v10 = vertex(p[in[1]], p[out[0]]), v11 = vertex(p[in[1]], p[out[1]]);
    // (in0, in1, out0, out1) is an even or odd order of the four.
    const int order[4] = {in[0], in[1], out[0], out[1]};
    int inversions = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
    const bool flip = (inversions % 2 == 1) != mirrored;
    add(v00, v01, v11, flip);
    add(v00, v11, v10, flip);
  }

  void cube(int x, int y, int z) {
    // The six ways from (0,0,0) to (1,1,1); even orders of the axes give a positive volume.
    static constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const std::size_t base = lattice.index(x, y, z);
    bool any_in = false, any_out = false;
    for (int i = 0; i < 8; ++i) {
      const bool inside = field[base + (i ? step[i - 1] : 0)] < 0;
      any_in |= inside;
      any_out |= !inside;
    }
    if (!any_in || !any_out) return;
    for (int k = 0; k < 6; ++k) {
      int bits = 0;
      std::array<std::size_t, 4> p{base, 0, 0, 0};
      for (int i = 0; i < 3; ++i) {
        bits |= 1 << kOrders[k][i];
        p[i + 1] = base + step[bits - 1];
      }
      tetrahedron(p, k >= 3);
    }
  }
};

}  // namespace

Lattice make_lattice(const Vector3d& low, const Vector3d& high, double margin_m, double step_m) {
  Lattice lattice;
  lattice.step_m = step_m;
  lattice.origin = low - Vector3d::Constant(margin_m);
  for (int k = 0; k < 3; ++k)
    lattice.size[k] = std::max(2, static_cast<int>(std::ceil((high[k] - low[k] + 2 * margin_m) / step_m)) + 1);
  return lattice;
}

std::vector<float> ball_field(const Lattice& lattice, std::vector<float> field, BallReport& report) {
  report = {};
  clear_border(lattice, field);
  if (std::none_of(field.begin(), field.end(), [](float f) { return f < 0; })) return {};
  report.filled_points = fill_hollows(lattice, field);
  const auto taken = ball_of(lattice, field);
  const float least = static_cast<float>(0.02 * lattice.step_m), cut = static_cast<float>(0.1 * lattice.step_m);
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (taken[i]) {
      field[i] = std::min(field[i], -least);
    } else {
      if (field[i] < 0) {
        ++report.cut_points;
        field[i] = cut;
      }
      field[i] = std::max(field[i], least);
    }
  }
  return field;
}

Mesh lattice_surface(const Lattice& lattice, const std::vector<float>& field) {
  SurfaceBuilder builder(lattice, field);
  const std::size_t slab = static_cast<std::size_t>(lattice.size[0]) * lattice.size[1];
  for (int z = 0; z + 1 < lattice.size[2]; ++z) {
    // The numbers of slab z + 1 replace those of slab z - 1.
    std::fill_n(builder.rows.begin() + ((z + 1) % 2) * slab, slab, SurfaceBuilder::empty_row());
    for (int y = 0; y + 1 < lattice.size[1]; ++y)
      for (int x = 0; x + 1 < lattice.size[0]; ++x) builder.cube(x, y, z);
  }
  return std::move(builder.mesh);
}

}  // namespace dressform
