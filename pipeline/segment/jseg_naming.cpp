#include "pipeline/segment/jseg_naming.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "scenes/disjoint_sets.h"

namespace dressform {
namespace {

constexpr double kMostlyExposed = 0.5;  // part of a region on head, hands and feet, to be taken for skin's colour

ColorSpread exposed_color(const std::vector<RegionFacts>& regions) {
  ColorSpread color;
  for (const RegionFacts& region : regions)
    if (region.exposed > kMostlyExposed) color.add(region.color);
  return color;
}

bool is_skin(const RegionFacts& region, const ColorSpread& exposed, const NamingParams& params) {
  if (region.offset_mm > params.skin_mm) return false;
  if (!std::isnan(region.unchanged)) return region.unchanged > params.unchanged_part;
  if (exposed.weight > 0) return color_distance(region.color, exposed) < params.skin_color;
  return region.exposed > kMostlyExposed;
}

// Clothes of one colour that hang together, over all views.
struct Cluster {
  std::vector<int> regions;  // none: went into another one
  std::set<int> beside;      // clusters
  ColorSpread color;
  double area_mm2 = 0, height = 0, upper = 0;  // height, upper: sums over the area
};

std::vector<Cluster> single_clusters(const std::vector<RegionFacts>& regions, const std::vector<Label>& names) {
  std::vector<Cluster> clusters(regions.size());
  for (int i = 0; i < static_cast<int>(regions.size()); ++i) {
    if (names[i] == Label::skin) continue;
    const RegionFacts& region = regions[i];
    Cluster& cluster = clusters[i];
    cluster.regions = {i};
    cluster.color = region.color;
    if (!std::isnan(region.height_m)) {
      cluster.area_mm2 = region.area_mm2;
      cluster.height = region.area_mm2 * region.height_m;
      cluster.upper = region.area_mm2 * (region.chest + region.sleeve);
    }
    for (const auto& [other, length] : region.beside)
      if (names[other] != Label::skin) cluster.beside.insert(other);
  }
  return clusters;
}

void unite(std::vector<Cluster>& clusters, int a, int b) {
  Cluster &into = clusters[a], from = std::move(clusters[b]);
  clusters[b] = {};
  into.regions.insert(into.regions.end(), from.regions.begin(), from.regions.end());
  into.color.add(from.color);
  into.area_mm2 += from.area_mm2, into.height += from.height, into.upper += from.upper;
  for (const int other : from.beside) {
    clusters[other].beside.erase(b);
    if (other != a) clusters[other].beside.insert(a), into.beside.insert(other);
  }
  into.beside.erase(b);
}

// Again and again the two of the nearest colours that touch.
std::vector<Cluster> clustered(std::vector<Cluster> clusters, double limit) {
  for (;;) {
    double least = limit;
    int first = -1, second = -1;
    for (int a = 0; a < static_cast<int>(clusters.size()); ++a)
      for (const int b : clusters[a].beside)
        if (const double d = a < b ? color_distance(clusters[a].color, clusters[b].color) : limit; d < least)
          least = d, first = a, second = b;
    if (first < 0) return clusters;
    unite(clusters, first, second);
  }
}

// Clothes above the hips are top, and so are those that cover the chest, whole dresses among them.
void name_clothes(const std::vector<RegionFacts>& regions, const Landmarks& limbs, const NamingParams& params,
                  std::vector<Label>& names) {
  for (const Cluster& cluster : clustered(single_clusters(regions, names), params.same_color)) {
    const bool top =
        cluster.height > limbs.hip_y * cluster.area_mm2 || cluster.upper > params.chest_part * cluster.area_mm2;
    for (const int i : cluster.regions) names[i] = top ? Label::top : Label::bottom;
  }
}

// The name of the longest border with regions that `counts` holds true for; `none` where there is no such region.
template <class Counts>
Label name_beside(const std::vector<RegionFacts>& regions, const std::vector<Label>& names,
                  const std::vector<int>& piece, const Counts& counts) {
  std::array<double, 4> length{0, 0, 0, 0};
  for (const int i : piece)
    for (const auto& [other, border] : regions[i].beside)
      if (counts(other)) length[static_cast<int>(names[other])] += border;
  const auto most = std::max_element(length.begin() + 1, length.end());
  return *most > 0 ? static_cast<Label>(most - length.begin()) : Label::none;
}

// Slivers along jumps of depth take the name beside them.
void rename_fringes(const std::vector<RegionFacts>& regions, double small_mm2, const NamingParams& params,
                    std::vector<Label>& names) {
  const auto is_fringe = [&](int i) {
    return regions[i].area_mm2 < small_mm2 && regions[i].fringe > params.fringe_part;
  };
  std::vector<Label> renamed = names;
  for (int i = 0; i < static_cast<int>(regions.size()); ++i) {
    if (!is_fringe(i)) continue;
    const Label beside = name_beside(regions, names, {i}, [&](int other) { return !is_fringe(other); });
    if (beside != Label::none) renamed[i] = beside;
  }
  names = std::move(renamed);
}

// Small pieces of one name, by themselves in space, take the name round them.
void rename_islands(const std::vector<RegionFacts>& regions, double small_mm2, std::vector<Label>& names) {
  DisjointSets sets(regions.size());
  for (int i = 0; i < static_cast<int>(regions.size()); ++i)
    for (const auto& [other, border] : regions[i].beside)
      if (names[other] == names[i]) sets.join(i, other);
  std::vector<std::vector<int>> pieces(regions.size());
  for (int i = 0; i < static_cast<int>(regions.size()); ++i) pieces[sets.root(i)].push_back(i);
  std::vector<Label> renamed = names;
  for (const auto& piece : pieces) {
    double area = 0;
    for (const int i : piece) area += regions[i].area_mm2;
    if (piece.empty() || area >= small_mm2) continue;
    const Label here = names[piece.front()];
    const Label beside = name_beside(regions, names, piece, [&](int other) { return names[other] != here; });
    if (beside != Label::none)
      for (const int i : piece) renamed[i] = beside;
  }
  names = std::move(renamed);
}

// A garment of hardly any cloth is part of the other one.
void drop_small_garments(const std::vector<RegionFacts>& regions, double least_mm2, std::vector<Label>& names) {
  std::array<double, 4> area{0, 0, 0, 0};
  for (std::size_t i = 0; i < regions.size(); ++i) area[static_cast<int>(names[i])] += regions[i].area_mm2;
  const auto into = [&](Label small, Label other) {
    if (area[static_cast<int>(small)] >= least_mm2) return;
    const Label to = area[static_cast<int>(other)] >= least_mm2 ? other : Label::skin;
    std::replace(names.begin(), names.end(), small, to);
  };
  into(Label::top, Label::bottom);
  into(Label::bottom, Label::top);
}

}  // namespace

std::vector<Label> region_names(const std::vector<RegionFacts>& regions, const Landmarks& limbs,
                                const NamingParams& params) {
  std::vector<Label> names(regions.size(), Label::none);
  const ColorSpread exposed = exposed_color(regions);
  double seen_mm2 = 0;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    seen_mm2 += regions[i].area_mm2;
    if (is_skin(regions[i], exposed, params)) names[i] = Label::skin;
  }
  name_clothes(regions, limbs, params, names);
  rename_fringes(regions, params.artefact_part * seen_mm2, params, names);
  rename_islands(regions, params.artefact_part * seen_mm2, names);
  drop_small_garments(regions, params.least_mm2, names);
  return names;
}

}  // namespace dressform
