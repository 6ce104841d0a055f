#include "pipeline/geometry/lattice.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace dressform {
namespace {

using Offset = std::array<int, 3>;

constexpr float kMostLayers = 16;  // taken off in search of a ball: what is thicker holds together
// Of a step: how far from the surface points are put that change sides, and that must not be on the surface itself.
constexpr double kMoved = 0.1, kOffSurface = 0.02;

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
    field[i] = -static_cast<float>(kMoved * lattice.step_m);
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
  for (float least = 0; least < kMostLayers; least += 1) {
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
  const float least = static_cast<float>(kOffSurface * lattice.step_m),
              cut = static_cast<float>(kMoved * lattice.step_m);
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

}  // namespace dressform
