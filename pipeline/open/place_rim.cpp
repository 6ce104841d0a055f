#include "pipeline/open/place_rim.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/geometry/sector.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kShortEnd = 0.05;        // weight of an end of the points that is short of the mask edges' curve
constexpr std::size_t kFewestEnds = 3;    // beside edges, to learn from
constexpr std::size_t kFewestPoints = 5;  // of a sector, to tell where it ends
constexpr double kMostShort_m = 0.04;     // that points end short of the cloth
constexpr double kEarlyEnd_m = 0.015;     // points that end this much before the others of a rim were not seen further
constexpr double kBeside = 0.15;          // radians: an edge there covers the end of a sector ...
constexpr double kSameRim_m = 0.1;        // ... within this of it along the limb
constexpr double kBelowTop_m = 0.02;      // a waist that nothing shows is cut this far below the surface's upper end

// Where the points that the surface was made from end, in the opening's coordinates: the farthest ones of each sector.
std::vector<RimSample> support_ends(const PointCloud& support, const Opening& opening, const OpenScene& scene) {
  constexpr int kSectors = 24;
  constexpr std::size_t kStrays = 2;  // of a sector, that may lie beyond the cloth
  std::vector<std::vector<double>> sectors(kSectors);
  for (const Vector3d& p : support.points) {
    if (!belongs(opening, scene.part_below(p), p, scene.landmarks)) continue;
    sectors[sector_of(opening.angle(p), kSectors)].push_back(opening.along(p));
  }
  std::vector<RimSample> samples;
  std::vector<double> ends;
  for (int i = 0; i < kSectors; ++i) {
    const auto& values = sectors[i];
    if (values.size() < kFewestPoints) continue;
    const double farthest = nth_value(values, values.size() - 1 - kStrays);
    samples.push_back({-M_PI + 2 * M_PI * (i + 0.5) / kSectors, farthest, 1});
    ends.push_back(samples.back().along);
  }
  if (ends.empty()) return samples;
  // Sectors that no view faces end early: they say nothing.
  const double typical = nth_value(ends, ends.size() * 2 / 3);
  samples.erase(std::remove_if(samples.begin(), samples.end(),
                               [&](const RimSample& s) { return s.along < typical - kEarlyEnd_m; }),
                samples.end());
  return samples;
}

// The edges, and the ends of the points in sectors without edges. Points end short of the cloth, as pixels at edges are
// dropped: by how much is learned from the sectors that have both. Where too few do, ends short of `rough`, the curve
// of the edges alone, say little.
std::vector<RimSample> completed(std::vector<RimSample> edges, const RimCurve& rough, std::vector<RimSample> ends) {
  std::vector<double> short_by;
  const auto covered = [&edges](const RimSample& end) {
    return std::any_of(edges.begin(), edges.end(), [&](const RimSample& edge) {
      return std::abs(std::remainder(edge.angle - end.angle, 2 * M_PI)) < kBeside &&
             std::abs(edge.along - end.along) < kSameRim_m;
    });
  };
  std::vector<RimSample> alone;
  for (const RimSample& end : ends) {
    if (covered(end))
      short_by.push_back(rough.at(end.angle) - end.along);
    else
      alone.push_back(end);
  }
  const bool known = short_by.size() >= kFewestEnds;
  const double usual_m = known ? std::clamp(median(short_by), 0.0, kMostShort_m) : 0;
  for (RimSample& end : alone) {
    if (known)
      end.along += usual_m;
    else if (end.along < rough.at(end.angle))
      end.weight *= kShortEnd;
    edges.push_back(end);
  }
  return edges;
}

}  // namespace

PlacedRim place_rim(const Opening& opening, const std::vector<RimSample>& edges, const ClosedGarment& closed,
                    const OpenScene& scene, const PlaceRimParams& params) {
  PlacedRim rim;
  rim.curve = fit_rim(edges, params.fit);
  if (rim.curve.coverage >= params.least_coverage) {
    if (is_leg(opening.limb))
      rim.curve = fit_rim(completed(edges, rim.curve, support_ends(closed.support, opening, scene)), params.fit);
    return rim;
  }
  rim.observed = false;
  if (opening.name == "waist") {
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vector3d& v : closed.mesh.vertices) highest = std::max(highest, v.y());
    const double height = std::min(scene.landmarks.waist_y, highest - kBelowTop_m);
    rim.curve.knots.assign(params.fit.knots, height - opening.centre.y());
    return rim;
  }
  rim.curve = fit_rim(support_ends(closed.support, opening, scene), params.fit);
  return rim;
}

}  // namespace dressform
