#include "pipeline/fuse/thigh_gap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "pipeline/body/body_limbs.h"
#include "pipeline/body/section_depth.h"

namespace dressform {
namespace {

constexpr double kKnee = 0.27;           // of the stature
constexpr double kMostOverlap_m = 0.03;  // of the legs seen from the front, where one stands before the other
constexpr double kBasis_m = 0.12;        // below the fork, from which the slit is drawn on upwards
constexpr float kTaken_m = 1e-4f;

// The middle between the legs, along the body's left, by height.
struct Slit {
  double first_y = 0, step = 0.01, top_y = 0;
  std::vector<double> middle;

  double at(double y) const {
    const double t = std::clamp((y - first_y) / step, 0.0, static_cast<double>(middle.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(t), middle.size() - 1), j = std::min(i + 1, middle.size() - 1);
    return middle[i] + (t - static_cast<double>(i)) * (middle[j] - middle[i]);
  }
};

// Half way between two legs' sections; absent where they overlap as seen from the front.
std::optional<double> middle_of(const SectionLoop& a, const SectionLoop& b, const Vector3d& left) {
  const bool a_left = a.centroid.dot(left) > b.centroid.dot(left);
  double inner_left = std::numeric_limits<double>::infinity(), inner_right = -inner_left;
  for (const Vector3d& p : (a_left ? a : b).points) inner_left = std::min(inner_left, p.dot(left));
  for (const Vector3d& p : (a_left ? b : a).points) inner_right = std::max(inner_right, p.dot(left));
  if (inner_left - inner_right < -kMostOverlap_m) return {};
  return (inner_left + inner_right) / 2;
}

double slit_top(const Sections& sections, const BodyLimbs& limbs) {
  const double stature = limbs.top_y - limbs.floor_y;
  for (int level = sections.level(limbs.floor_y + kHighestCrotch * stature); sections.y(level) > limbs.crotch_y;
       --level)
    if (!sections.levels[level].empty() && thighs_that_touch(sections.levels[level][0], limbs, stature))
      return sections.y(level);
  return limbs.crotch_y - sections.step;
}

// Drawn on as a straight line over heights where the legs are one.
void draw_on(Slit& slit, std::size_t levels) {
  const auto basis = std::min(slit.middle.size(), static_cast<std::size_t>(kBasis_m / slit.step));
  const std::size_t from = slit.middle.size() - basis;
  double mean_t = 0, mean = 0, slope = 0, spread = 0;
  for (std::size_t i = from; i < slit.middle.size(); ++i) {
    mean_t += static_cast<double>(i) / static_cast<double>(basis);
    mean += slit.middle[i] / static_cast<double>(basis);
  }
  for (std::size_t i = from; i < slit.middle.size(); ++i) {
    const double t = static_cast<double>(i) - mean_t;
    slope += t * (slit.middle[i] - mean);
    spread += t * t;
  }
  slope = spread > 0 ? slope / spread : 0;
  while (slit.middle.size() < levels)
    slit.middle.push_back(mean + slope * (static_cast<double>(slit.middle.size()) - mean_t));
}

std::optional<Slit> find_slit(const Sections& sections, const BodyLimbs& limbs) {
  if (!limbs.left_leg || !limbs.right_leg) return {};
  const int knee = sections.level(limbs.floor_y + kKnee * (limbs.top_y - limbs.floor_y));
  Slit slit;
  slit.first_y = sections.y(knee);
  slit.step = sections.step;
  slit.top_y = slit_top(sections, limbs);
  for (int level = knee; sections.y(level) < limbs.crotch_y - 0.5 * sections.step; ++level) {
    const auto& loops = sections.levels[level];
    if (loops.size() < 2) return {};
    const auto middle = middle_of(loops[0], loops[1], limbs.left);
    if (!middle) return {};
    slit.middle.push_back(*middle);
  }
  if (slit.middle.size() < 3) return {};
  draw_on(slit, static_cast<std::size_t>(std::max(0.0, std::ceil((slit.top_y - slit.first_y) / slit.step))) + 1);
  return slit;
}

}  // namespace

bool part_thighs(const Lattice& lattice, const Mesh& surface, double gap_m, std::vector<float>& field) {
  const Sections sections = horizontal_sections(surface);
  const BodyLimbs limbs = find_limbs(surface, sections);
  const auto slit = find_slit(sections, limbs);
  if (!slit) return false;
  std::vector<char> taken(field.size(), 0);
  tbb::parallel_for(std::size_t{0}, field.size(), [&](std::size_t i) {
    const Vector3d p = lattice.point(i);
    const double off = gap_m / 2 - std::abs(p.dot(limbs.left) - slit->at(p.y()));
    const auto empty = static_cast<float>(std::min({off, slit->top_y - p.y(), p.y() - slit->first_y}));
    if (empty <= field[i] + kTaken_m || empty < -static_cast<float>(lattice.step_m)) return;
    taken[i] = 1;
    field[i] = empty;
  });
  return std::any_of(taken.begin(), taken.end(), [](char t) { return t != 0; });
}

}  // namespace dressform
