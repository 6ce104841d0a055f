#include "pipeline/body/standing_body.h"

#include <algorithm>

namespace dressform {

const SectionLoop* StandingBody::trunk_loop(double y) const {
  if (y < sections.first_y || sections.levels.empty()) return nullptr;
  const auto& level = sections.levels[sections.level(y)];
  return level.empty() ? nullptr : &level[0];
}

double height_at(const std::vector<double>& marks, double t) {
  const int i = std::clamp(static_cast<int>(t), 0, static_cast<int>(marks.size()) - 2);
  return marks[i] + (t - i) * (marks[i + 1] - marks[i]);
}

TrunkOutline StandingBody::outline_at(double y) const {
  if (y < sections.first_y || sections.levels.empty()) return {};
  return trunk_outline(sections.levels[sections.level(y)], landmarks.axis, landmarks.left, landmarks.stature);
}

}  // namespace dressform
