#include "pipeline/fuse/body_ends.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/geometry/mesh_query.h"

namespace dressform {
namespace {

constexpr double kHand = 0.108, kAnkle = 0.039;  // of the stature: length of a hand, height of an ankle
constexpr double kWidens = 1.25;                 // girth over the neck's, where it becomes the shoulders
constexpr double kNone = std::numeric_limits<double>::infinity();

// Height at which the neck ends below: going down from it, its section widens, or arms and trunk are apart no more.
double neck_base(const Mesh& surface, const Landmarks& marks) {
  const Sections sections = horizontal_sections(surface);
  int level = sections.level(marks.neck_y);
  if (level < 0 || sections.levels[level].empty()) return kNone;
  const double girth = tape_girth(sections.levels[level].front());
  while (level > 0 && sections.y(level) > marks.armpit_y && !sections.levels[level].empty() &&
         tape_girth(sections.levels[level].front()) < kWidens * girth)
    --level;
  return sections.y(level);
}

struct Ends {
  double neck_y = kNone, ankle_y = -kNone;
  double wrist_along[2] = {kNone, kNone};  // of each arm's axis

  // How far a point of a part of the body is beyond where that part ends, metres; negative: it stays.
  double beyond(const Landmarks& marks, BodyPart part, const Vector3d& point) const {
    if (is_arm(part)) {
      const int side = side_of(part);
      const Limb* arm = marks.arm(side);
      return arm ? arm->along(point) - wrist_along[side] : -kNone;
    }
    return is_leg(part) ? ankle_y - point.y() : std::max(point.y() - neck_y, ankle_y - point.y());
  }
};

Ends ends_of(const Mesh& surface, const Landmarks& marks) {
  Ends ends;
  if (marks.neck_y > 0) ends.neck_y = neck_base(surface, marks);
  if (marks.left_leg || marks.right_leg) ends.ankle_y = marks.floor_y + kAnkle * marks.stature;
  for (const int side : {0, 1})
    if (const Limb* arm = marks.arm(side)) ends.wrist_along[side] = arm->length - kHand * marks.stature;
  return ends;
}

}  // namespace

bool cut_ends(const Lattice& lattice, const Mesh& surface, std::vector<float>& field) {
  const Landmarks marks = find_landmarks(surface);
  const Ends ends = ends_of(surface, marks);
  const MeshQuery query(surface);
  std::vector<char> taken(field.size(), 0);
  tbb::parallel_for(std::size_t{0}, field.size(), [&](std::size_t i) {
    if (field[i] >= 0) return;
    const Vector3d point = lattice.point(i);
    const auto d = static_cast<float>(ends.beyond(marks, marks.part_of(query.closest(point).triangle), point));
    if (d <= field[i]) return;
    field[i] = d;
    taken[i] = d > 0;
  });
  return std::any_of(taken.begin(), taken.end(), [](char t) { return t != 0; });
}

}  // namespace dressform
