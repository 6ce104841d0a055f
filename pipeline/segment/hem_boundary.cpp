#include "pipeline/segment/hem_boundary.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "pipeline/garment/garment_kind.h"
#include "pipeline/segment/cloth_zones.h"
#include "pipeline/segment/hem_curve.h"
#include "pipeline/segment/hem_edges.h"
#include "pipeline/segment/hem_evidence.h"
#include "pipeline/segment/view_models.h"

namespace dressform {
namespace {

constexpr float kBinNats = 6;            // most that one cell of the curve's grid says
constexpr float kFullCell = 6;           // pixels from which a cell counts in full
constexpr float kSeedNats = 4;           // of a cell that is surely top or bottom
constexpr double kPlainNats = 2.5;       // no other curve can tell the colours much better
constexpr int kOffPlane_rows = 14;       // that a hem may lie from the plane through it
constexpr double kLeastSeed_mm2 = 1500;  // of cloth to learn the bottom's colours from
constexpr float kApart_m = 0.02;         // colours are learnt this far from the curve
constexpr int kFewestParted = 2;         // heights at which legs have to be apart
constexpr double kHand = 0.05;           // of the stature: about the breadth of a hand

using Zones = std::vector<cv::Mat>;

bool goes_round_each_leg(const ClothViews& all, const Zones& zones) {
  std::vector<Vector3d> low;
  for (std::size_t k = 0; k < all.views.size(); ++k) {
    each_cloth_pixel(all.views[k], all.cloth[k], [&](int v, int u) {
      const auto& p = all.views[k].place_m.at<cv::Vec3f>(v, u);
      if (all.views[k].measured.at<uchar>(v, u) && zones[k].at<uchar>(v, u) == kSureBottom)
        low.emplace_back(p[0], p[1], p[2]);
    });
  }
  const LegVotes votes = leg_votes(low, all.landmarks);
  return votes.parts >= kFewestParted && votes.part();
}

// Per pixel, the colour's nats in favour of top.
std::vector<cv::Mat> color_nats(const ClothViews& all, const std::vector<cv::Mat>& top,
                                const std::vector<cv::Mat>& bottom, double most_nats) {
  const auto images = lab_images(all.views);
  const auto top_colors = shared_models(top, images), bottom_colors = shared_models(bottom, images);
  const auto most = static_cast<float>(most_nats);
  std::vector<cv::Mat> nats(all.views.size());
  tbb::parallel_for(std::size_t{0}, all.views.size(), [&](std::size_t k) {
    if (all.views[k].box.empty()) return;
    nats[k] = cv::Mat::zeros(all.views[k].box.size(), CV_32F);
    for (int v = 0; v < nats[k].rows; ++v) {
      for (int u = 0; u < nats[k].cols; ++u) {
        if (!all.cloth[k].at<uchar>(v, u)) continue;
        const auto& color = all.views[k].lab.at<cv::Vec3b>(v, u);
        nats[k].at<float>(v, u) =
            std::clamp(top_colors[k].log_density(color) - bottom_colors[k].log_density(color), -most, most);
      }
    }
  });
  return nats;
}

// All views' nats on the grid of directions and heights.
cv::Mat gathered_nats(const ClothViews& all, const std::vector<cv::Mat>& zones, const std::vector<cv::Mat>& by_view) {
  cv::Mat sum = cv::Mat::zeros(all.grid.rows, TrunkGrid::kColumns, CV_32F), count = sum.clone(), seed = sum.clone();
  for (std::size_t k = 0; k < all.views.size(); ++k) {
    each_cloth_pixel(all.views[k], all.cloth[k], [&](int v, int u) {
      const uchar zone = zones[k].at<uchar>(v, u);
      if (zone == kSleeve) return;
      const auto& place = all.views[k].place_m.at<cv::Vec3f>(v, u);
      const int r = all.grid.row(place), c = all.grid.column(place);
      sum.at<float>(r, c) += by_view[k].at<float>(v, u);
      count.at<float>(r, c) += 1;
      if (zone != kBetween) seed.at<float>(r, c) = zone == kSureTop ? kSeedNats : -kSeedNats;
    });
  }
  cv::Mat nats = seed;
  for (int r = 0; r < all.grid.rows; ++r) {
    for (int c = 0; c < TrunkGrid::kColumns; ++c) {
      const float pixels = count.at<float>(r, c);
      if (pixels == 0) continue;
      const float full = std::min(1.f, pixels / kFullCell);
      nats.at<float>(r, c) += std::clamp(sum.at<float>(r, c) / pixels * 2 * full, -kBinNats, kBinNats);
    }
  }
  return nats;
}

// The curve of the grid's nats, held near a plane.
std::vector<int> hem_of(const cv::Mat& nats, double row_price) {
  const std::vector<int> first = trace_hem(nats, row_price);
  return trace_hem(near_plane(nats, first, kOffPlane_rows, kBinNats), row_price);
}

// Pixels of one view surely above and below the curve.
struct Sides {
  cv::Mat top, bottom;
};
Sides split_by_curve(const ClothViews& all, const Zones& zones, std::size_t k, const std::vector<int>& hem) {
  Sides sides{cv::Mat::zeros(all.views[k].box.size(), CV_8U), cv::Mat::zeros(all.views[k].box.size(), CV_8U)};
  each_cloth_pixel(all.views[k], all.cloth[k], [&](int v, int u) {
    const float height = all.grid.above(all.views[k].place_m.at<cv::Vec3f>(v, u), hem);
    const bool sleeve = zones[k].at<uchar>(v, u) == kSleeve;
    if (sleeve || height > kApart_m) sides.top.at<uchar>(v, u) = 255;
    if (!sleeve && height < -kApart_m) sides.bottom.at<uchar>(v, u) = 255;
  });
  return {eroded(sides.top, 1), eroded(sides.bottom, 1)};
}

// By colours: learnt from the zones, then from what the curve parts, and so on.
HemBoundary traced(const ClothViews& all, const Zones& zones, const TopBottomParams& params) {
  std::vector<cv::Mat> top(all.views.size()), bottom(all.views.size());
  for (std::size_t k = 0; k < all.views.size(); ++k) {
    if (zones[k].empty()) continue;
    top[k] = eroded((zones[k] == kSureTop) | (zones[k] == kSleeve), 1);
    bottom[k] = eroded(zones[k] == kSureBottom, 1);
  }
  HemBoundary found;
  for (int round = 0; round < params.rounds; ++round) {
    found.nats = color_nats(all, top, bottom, params.color_nats);
    found.rows = hem_of(gathered_nats(all, zones, found.nats), params.row_price);
    for (std::size_t k = 0; k < all.views.size(); ++k) {
      if (zones[k].empty()) continue;
      const Sides sides = split_by_curve(all, zones, k, found.rows);
      top[k] = sides.top;
      bottom[k] = sides.bottom;
    }
  }
  found.nats = color_nats(all, top, bottom, params.color_nats);
  return found;
}

// For garments of the same colours: where one hangs over the other.
HemBoundary traced_edges(const ClothViews& all, const Zones& zones, const TopBottomParams& params) {
  std::vector<cv::Mat> told(all.views.size());
  for (std::size_t k = 0; k < all.views.size(); ++k)
    if (!zones[k].empty()) told[k] = (zones[k] != kNowhere) & (zones[k] != kSleeve);
  const double hand = kHand * (all.landmarks.top_y - all.landmarks.floor_y);
  HemBoundary found;
  found.rows =
      hem_of(edge_nats(all.views, told, all.grid, all.landmarks.crotch_y - 2 * hand, all.landmarks.armpit_y - hand),
             params.row_price);
  found.nats.resize(all.views.size());
  for (std::size_t k = 0; k < all.views.size(); ++k)
    if (!all.views[k].box.empty()) found.nats[k] = cv::Mat::zeros(all.views[k].box.size(), CV_32F);
  return found;
}

HemEvidence judged(const ClothViews& all, const Zones& zones, const std::vector<int>& hem) {
  std::vector<CurveOnView> curve(all.views.size());
  for (std::size_t k = 0; k < all.views.size(); ++k) {
    if (all.views[k].box.empty()) continue;
    curve[k].above_m = cv::Mat(all.views[k].box.size(), CV_32F, cv::Scalar(std::nanf("")));
    curve[k].column = cv::Mat::zeros(all.views[k].box.size(), CV_8U);
    each_cloth_pixel(all.views[k], all.cloth[k], [&](int v, int u) {
      if (zones[k].at<uchar>(v, u) == kSleeve) return;
      const auto& place = all.views[k].place_m.at<cv::Vec3f>(v, u);
      curve[k].above_m.at<float>(v, u) = all.grid.above(place, hem);
      curve[k].column.at<uchar>(v, u) = static_cast<uchar>(all.grid.column(place));
    });
  }
  return hem_evidence(all.views, curve);
}

bool differ(const HemEvidence& evidence, const TopBottomParams& params) {
  return evidence.color_nats >= params.least_nats && evidence.below_mm2 >= params.least_mm2 &&
         std::min(evidence.told_above, evidence.told_below) >= params.least_share;
}

}  // namespace

// The bottom's first colours are those low on the legs, at the lower end of the cloth, or those there that are foreign
// to the top: the curve that tells the colours best stands.
std::optional<HemBoundary> find_hem_boundary(const ClothViews& all, const std::vector<cv::Mat>& zones,
                                             const TopBottomParams& params) {
  const std::function<Zones(Zones)> starts[] = {
      [](Zones low) { return low; },
      [&](Zones low) { return with_lower_end(std::move(low), all.views, all.cloth, all.landmarks, all.grid); },
      [&](Zones end) { return without_colors_of_top(std::move(end), all.views, all.cloth, all.landmarks); }};
  std::optional<HemBoundary> best;
  double most_nats = -1;
  Zones seeds = zones;
  for (const auto& start : starts) {
    seeds = start(seeds);
    if (zone_area_mm2(seeds, all.views, kSureBottom) < kLeastSeed_mm2) continue;
    HemBoundary found = traced(all, seeds, params);
    const HemEvidence evidence = judged(all, seeds, found.rows);
    if (!differ(evidence, params) || evidence.color_nats <= most_nats) continue;
    most_nats = evidence.color_nats;
    best = std::move(found);
    if (most_nats > kPlainNats) break;
  }
  if (best) return best;
  const bool forked =
      zone_area_mm2(zones, all.views, kSureBottom) >= params.least_mm2 && goes_round_each_leg(all, zones);
  if (forked) return traced_edges(all, zones, params);
  return {};
}

}  // namespace dressform
