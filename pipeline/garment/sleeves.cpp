#include "pipeline/garment/sleeves.h"

#include <algorithm>
#include <cmath>

#include "pipeline/body/body_chart.h"
#include "pipeline/geometry/sector.h"

namespace dressform {
namespace {

constexpr double kBin_m = 0.04;
constexpr int kSectors = 8, kBins = 25, kEnclosing = 7;
constexpr double kSleeveReach_m = 0.16;  // the widest sleeve, from the arm's axis

}  // namespace

std::array<double, 2> sleeve_ends(const Mesh& garment, const Landmarks& landmarks) {
  const BodyChart chart(landmarks);
  std::array<double, 2> ends{0, 0};
  for (int side = 0; side < 2; ++side) {
    if (!landmarks.arm(side)) continue;
    std::array<std::array<int, kSectors>, kBins> seen{};
    for (const auto& p : garment.vertices) {
      const ChartPlace place = chart.place(p, arm_part(side));
      if (place.along_m < 0 || place.along_m >= kBins * kBin_m || place.radius_m > kSleeveReach_m) continue;
      ++seen[static_cast<int>(place.along_m / kBin_m)][sector_of(place.angle, kSectors)];
    }
    // Near the armpit, and as far down as a sleeve is one with the trunk's cloth, it does not enclose the arm; it does
    // again further down.
    for (int bin = 0; bin < kBins; ++bin)
      if (std::count_if(seen[bin].begin(), seen[bin].end(), [](int n) { return n > 0; }) >= kEnclosing)
        ends[side] = (bin + 1) * kBin_m;
  }
  return ends;
}

GarmentLayout with_sleeve_ends(GarmentLayout layout, const Mesh& garment, const Landmarks& landmarks) {
  if (!layout.upper()) return layout;
  const auto ends = sleeve_ends(garment, landmarks);
  for (int side = 0; side < 2; ++side) {
    layout.arms[side].end_m = ends[side];
    layout.arms[side].free_m = std::min(layout.arms[side].free_m, ends[side]);
  }
  return layout;
}

std::vector<char> exposed_arm_triangles(const KnownBody& body, const GarmentLayout& layout, double margin_m) {
  const BodyChart chart(body.landmarks);
  std::vector<char> bare(body.body.triangles.size(), 0);
  for (std::size_t i = 0; i < bare.size(); ++i) {
    const BodyPart part = body.landmarks.triangle_parts[i];
    if (!is_arm(part) || !body.landmarks.arm(side_of(part))) continue;
    const Vector3d& corner = body.body.vertices[body.body.triangles[i][0]];
    bare[i] = chart.place(corner, part).along_m > layout.arms[side_of(part)].end_m + margin_m;
  }
  return bare;
}

}  // namespace dressform
