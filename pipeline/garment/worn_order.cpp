#include "pipeline/garment/worn_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pipeline/geometry/sector.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr int kSectors = 24;          // of the turn, one vote each
constexpr int kFewestSectors = 6;     // that have to show both garments
constexpr double kMost = 0.7;         // of the votes that have to agree
constexpr double kClearly_m = 0.003;  // the median's lead
constexpr double kApart_m = 0.06;     // ends further from each other do not meet
constexpr double kBand_m = 0.03;      // on both sides of where they meet

struct Point {
  double y = 0;
  const Vector3d* place = nullptr;
};
using Ring = std::array<std::vector<Point>, kSectors>;

Ring ring_of(const PointCloud& cloud, const Vector3d& axis, const MeshQuery& naked, const Landmarks& limbs,
             double lowest) {
  Ring ring;
  for (const Vector3d& p : cloud.points) {
    if (p.y() < lowest) continue;
    if (is_arm(limbs.part_of(naked.closest(p).triangle))) continue;
    ring[sector_of(std::atan2(p.z() - axis.z(), p.x() - axis.x()), kSectors)].push_back({p.y(), &p});
  }
  for (auto& sector : ring)
    std::sort(sector.begin(), sector.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
  return ring;
}

double median_off_body(const std::vector<Point>& sector, double low, double high, const MeshQuery& naked) {
  std::vector<double> off;
  for (const Point& p : sector)
    if (p.y > low && p.y < high) off.push_back(naked.signed_distance(*p.place));
  if (off.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  return median(std::move(off));
}

// How much further off the body the bottom lies than the top above it; not a number where they do not meet.
double lead_m(const std::vector<Point>& top, const std::vector<Point>& bottom, const MeshQuery& naked) {
  constexpr std::size_t kFewest = 20, kStrays = 3;
  if (top.size() < kFewest || bottom.size() < kFewest) return std::numeric_limits<double>::quiet_NaN();
  const double low = top[kStrays].y, high = bottom[bottom.size() - 1 - kStrays].y, seam = (low + high) / 2;
  if (low - high > kApart_m) return std::numeric_limits<double>::quiet_NaN();
  return median_off_body(bottom, seam - kBand_m, high + kBand_m, naked) -
         median_off_body(top, low - kBand_m, seam + kBand_m, naked);
}

}  // namespace

WornOrder worn_order(const PointCloud& top, const PointCloud& bottom, const MeshQuery& naked,
                     const Landmarks& landmarks) {
  if (top.points.empty() || bottom.points.empty()) return {};
  const Vector3d axis = landmarks.neck;
  const Ring above = ring_of(top, axis, naked, landmarks, landmarks.crotch_y),
             below = ring_of(bottom, axis, naked, landmarks, landmarks.crotch_y);
  std::vector<double> leads;
  for (int i = 0; i < kSectors; ++i) {
    const double lead = lead_m(above[i], below[i], naked);
    if (std::isfinite(lead)) leads.push_back(lead);
  }
  if (leads.size() < kFewestSectors) return {Worn::over, 0};
  const auto ahead = std::count_if(leads.begin(), leads.end(), [](double lead) { return lead > 0; });
  const double part = static_cast<double>(ahead) / static_cast<double>(leads.size());
  const bool tucked = ahead >= kMost * leads.size() && median(leads) > kClearly_m;
  return {tucked ? Worn::under : Worn::over, std::abs(2 * part - 1)};
}

}  // namespace dressform
