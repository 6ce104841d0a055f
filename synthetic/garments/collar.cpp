#include "synthetic/garments/collar.h"

#include <algorithm>
#include <cmath>

#include "scenes/error.h"
#include "synthetic/geometry/self_intersection.h"
#include "synthetic/geometry/surface_distance.h"

namespace dressform {
namespace {

constexpr double kOffBody = 0.007;                     // of the collar, m
constexpr double kOffCloth[] = {0.006, 0.009, 0.013};  // of the fall off what it lies on, m: the first that works
constexpr double kWidestRow = 0.018;                   // across the collar, m
constexpr double kFold = 0.008;                        // across the fold, m
constexpr double kPoint = 0.35;                        // by which part the fall is longer at its ends in front
constexpr double kPointWidth = 0.05;                   // over which it grows longer, m
constexpr double kLean = 0.35;                         // of the stand towards the neck
constexpr double kPressed = 0.02;                      // of the stiffness along a fold or a seam
constexpr double kTwoLayers = 5;                       // of the stiffness in the collar

// The longest run of the rim along the seam, in the rim's order.
std::vector<int> sewn_part(const Mesh& cloth, const std::vector<int>& rim, const Level& seam) {
  const int count = static_cast<int>(rim.size());
  const auto free = [&](int i) { return seam(cloth.vertices[rim[i % count]]) < -0.003; };
  int start = 0, longest = 0;
  for (int i = 0; i < count; ++i) {
    int length = 0;
    while (length < count && !free(i + length)) ++length;
    if (length > longest) start = i, longest = length;
  }
  std::vector<int> part;
  for (int i = 0; i < longest; ++i) part.push_back(rim[(start + i) % count]);
  return part;
}

// Lays the collar, one column after the other, into upright planes through the neck's axis.
class Layer {
 public:
  Layer(const Mesh& cloth, const Body& body, const Vector3d& axis, double off_cloth_m)
      : cloth_(cloth), body_(body.mesh), axis_(axis), off_cloth_m_(off_cloth_m) {}

  // Rows above `base`, without it.
  std::vector<Vector3d> column(const Vector3d& base, double stand_m, double fall_m, int stand_rows,
                               int fall_rows) const {
    Vector3d out = base - axis_;
    out.y() = 0;
    out.normalize();
    std::vector<Vector3d> rows;
    Vector3d at = base;
    for (int k = 0; k < stand_rows; ++k) {
      at += stand_m / stand_rows * Vector3d(-kLean * out.x(), 1, -kLean * out.z()).normalized();
      while (!clear_of_body(at)) at += 0.001 * out;
      rows.push_back(at);
    }
    const std::vector<Vector3d> stand = rows;
    at += kFold * Vector3d(0.9 * out.x(), 0.4, 0.9 * out.z()).normalized();
    rows.push_back(at);
    for (int k = 0; k < fall_rows; ++k) rows.push_back(at = next(at, out, fall_m / fall_rows, base, stand));
    return rows;
  }

 private:
  bool clear_of_body(const Vector3d& p) const {
    const auto near = body_.closest(p, 0.03);
    return !near.found || near.height >= kOffBody;
  }

  bool clear(const Vector3d& p, const Vector3d& base, const std::vector<Vector3d>& stand) const {
    if (!clear_of_body(p)) return false;
    const auto near = cloth_.closest(p, 0.03);
    if (near.found && (near.distance < off_cloth_m_ || near.height < 0)) return false;
    Vector3d from = base;
    for (const Vector3d& to : stand) {
      const double t = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
      if ((p - from - t * (to - from)).norm() < off_cloth_m_) return false;
      from = to;
    }
    return true;
  }

  // As steeply down as there is room.
  Vector3d next(const Vector3d& from, const Vector3d& out, double step, const Vector3d& base,
                const std::vector<Vector3d>& stand) const {
    for (double down = 1.25; down > -0.6; down -= 0.05) {
      const Vector3d direction = std::cos(down) * out - std::sin(down) * Vector3d::UnitY();
      if (clear(from + step * direction, base, stand) && clear(from + 0.5 * step * direction, base, stand))
        return from + step * direction;
    }
    return from + step * out;
  }

  SurfaceDistance cloth_, body_;
  Vector3d axis_;
  double off_cloth_m_;
};

// The collar flat: how far along the seam its columns stand, and across it the rows.
struct FlatCollar {
  std::vector<double> along, across;
  // The rim runs to the left seen from outside; the collar rises from it.
  Vector2d place(int column, int row) const {
    return {0.5 * along.back() - along[column], across.back() - across[row]};
  }
};

FlatCollar flat_collar(const Mesh& cloth, const std::vector<int>& base, const CollarCut& cut, int stand_rows,
                       int fall_rows) {
  FlatCollar flat{{0}, {0}};
  for (size_t i = 1; i < base.size(); ++i)
    flat.along.push_back(flat.along.back() + (cloth.vertices[base[i]] - cloth.vertices[base[i - 1]]).norm());
  for (int r = 0; r < stand_rows; ++r) flat.across.push_back(flat.across.back() + cut.stand_m / stand_rows);
  flat.across.push_back(flat.across.back() + kFold);
  for (int r = 0; r < fall_rows; ++r) flat.across.push_back(flat.across.back() + cut.fall_m / fall_rows);
  return flat;
}

// Joins the columns, whose vertices stand at the end of the mesh, to `base` and to one another.
void add_triangles(const std::vector<int>& base, int rows, const FlatCollar& flat, CollaredCloth& out) {
  const int columns = static_cast<int>(base.size());
  const int first = static_cast<int>(out.mesh.vertices.size()) - columns * rows;
  const auto add = [&](const std::array<std::pair<int, int>, 3>& corners) {
    Vector3i t;
    std::array<Vector2d, 3> places;
    for (int k = 0; k < 3; ++k) {
      const auto [i, r] = corners[k];
      t[k] = r == 0 ? base[i] : first + i * rows + r - 1;
      places[k] = flat.place(i, r);
    }
    out.mesh.triangles.push_back(t);
    out.places.push_back(places);
  };
  for (int i = 0; i + 1 < columns; ++i)
    for (int r = 0; r < rows; ++r) {
      const std::pair<int, int> a{i, r}, b{i + 1, r}, c{i, r + 1}, d{i + 1, r + 1};
      const bool first_half = i < columns / 2;  // diagonals alike on both sides
      add(first_half ? std::array{b, a, c} : std::array{b, a, d});
      add(first_half ? std::array{b, c, d} : std::array{a, c, d});
    }
}

// The collar at a distance from what it lies on, whatever it meets.
CollaredCloth laid_on(const Mesh& cloth, const std::vector<int>& rim, const CollarCut& cut, const Body& body,
                      double edge_m, double off_cloth_m) {
  const double row_m = std::min(edge_m, kWidestRow);
  const int stand_rows = std::max(1, static_cast<int>(std::lround(cut.stand_m / row_m)));
  const int fall_rows = std::max(2, static_cast<int>(std::lround(cut.fall_m / row_m)));
  const std::vector<int> base = sewn_part(cloth, rim, cut.seam);
  const FlatCollar flat = flat_collar(cloth, base, cut, stand_rows, fall_rows);
  Vector3d axis = Vector3d::Zero();
  for (int i : rim) axis += cloth.vertices[i] / static_cast<double>(rim.size());

  CollaredCloth result;
  result.mesh = cloth;
  result.row.assign(cloth.vertices.size(), -1);
  result.fold_row = stand_rows;
  const Layer layer(cloth, body, axis, off_cloth_m);
  for (size_t i = 0; i < base.size(); ++i) {
    const double to_end = std::min(flat.along[i], flat.along.back() - flat.along[i]);
    const double fall_m = cut.fall_m * (1 + kPoint * std::max(0.0, 1 - to_end / kPointWidth));
    result.row[base[i]] = 0;
    int row = 0;
    for (const Vector3d& p : layer.column(cloth.vertices[base[i]], cut.stand_m, fall_m, stand_rows, fall_rows)) {
      result.mesh.vertices.push_back(p);
      result.row.push_back(++row);
    }
  }
  add_triangles(base, stand_rows + 1 + fall_rows, flat, result);
  return result;
}

}  // namespace

std::vector<double> CollaredCloth::bending(const Features& features) const {
  std::vector<double> parts;
  for (const auto& e : features.edges) {
    const int low = std::min(row[e[0]], row[e[1]]), high = std::max(row[e[0]], row[e[1]]);
    const bool crease = low == high && (low == 0 || low == fold_row || low == fold_row + 1);
    parts.push_back(low < 0 ? 1 : crease ? kPressed : kTwoLayers);
  }
  return parts;
}

CollaredCloth with_collar(const Mesh& cloth, const std::vector<int>& rim, const CollarCut& cut, const Body& body,
                          double edge_m) {
  for (const double off_m : kOffCloth) {
    CollaredCloth result = laid_on(cloth, rim, cut, body, edge_m, off_m);
    if (!result.places.empty() && self_intersections(result.mesh) == 0 &&
        crossing_triangles(result.mesh, body.mesh).empty())
      return result;
  }
  throw InputError("garment.collar",
                   "found a neck that leaves \"polo\" no room; expected a neck that rises clear of the shoulders, "
                   "or a smaller garment.cloth_edge_m");
}

}  // namespace dressform
