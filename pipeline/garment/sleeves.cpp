#include "pipeline/garment/sleeves.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr double kBin_m = 0.04;
constexpr int kSectors = 8, kBins = 25, kEnclosing = 7;
constexpr double kSleeveReach_m = 0.16;  // the widest sleeve, from the arm's axis

}  // namespace

std::array<double, 2> sleeve_ends(const Mesh& garment, const BodyLimbs& limbs) {
  std::array<double, 2> ends{0, 0};
  for (int side = 0; side < 2; ++side) {
    const Limb* arm = limbs.arm(side);
    if (!arm) continue;
    std::array<std::array<int, kSectors>, kBins> seen{};
    const Vector3d u = limbs.front.cross(arm->direction).normalized(), v = arm->direction.cross(u);
    for (const auto& p : garment.vertices) {
      const double along = arm->along(p);
      const Vector3d out = p - arm->root - along * arm->direction;
      if (along < 0 || along >= kBins * kBin_m || out.norm() > kSleeveReach_m) continue;
      const double angle = std::atan2(out.dot(v), out.dot(u)) / (2 * M_PI) + 1;
      ++seen[static_cast<int>(along / kBin_m)][static_cast<int>(angle * kSectors) % kSectors];
    }
    // Near the armpit, and as far down as a sleeve is one with the trunk's cloth, it does not enclose the arm; it does
    // again further down.
    for (int bin = 0; bin < kBins; ++bin)
      if (std::count_if(seen[bin].begin(), seen[bin].end(), [](int n) { return n > 0; }) >= kEnclosing)
        ends[side] = (bin + 1) * kBin_m;
  }
  return ends;
}

std::vector<char> exposed_arm_triangles(const Mesh& body, const BodyLimbs& limbs, const Mesh& garment,
                                        double margin_m) {
  const auto ends = sleeve_ends(garment, limbs);
  std::vector<char> bare(body.triangles.size(), 0);
  for (std::size_t i = 0; i < bare.size(); ++i) {
    const BodyPart part = limbs.triangle_parts[i];
    if (!is_arm(part)) continue;
    const int side = part == BodyPart::left_arm ? 0 : 1;
    const Limb* arm = limbs.arm(side);
    bare[i] = arm && arm->along(body.vertices[body.triangles[i][0]]) > ends[side] + margin_m;
  }
  return bare;
}

}  // namespace dressform
