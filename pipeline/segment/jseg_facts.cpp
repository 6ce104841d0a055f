#include "pipeline/segment/jseg_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "pipeline/segment/cloth_zones.h"
#include "pipeline/segment/color_change.h"
#include "pipeline/segment/view_models.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kLightnessWeight = 0.5;
constexpr std::size_t kLeastKnown = 10;  // pixels, to say what part of them is unchanged

double distance_m(const cv::Vec3f& a, const cv::Vec3f& b) { return cv::norm(a - b); }

// uint8: 255 within fringe_px of where the depth jumps or the body ends.
cv::Mat fringe_of(const ViewEvidence& view, const FactParams& params) {
  cv::Mat inside = view.body.clone();
  for (int v = 0; v < inside.rows; ++v) {
    for (int u = 0; u < inside.cols; ++u) {
      const auto& here = view.place_m.at<cv::Vec3f>(v, u);
      for (const auto& [dv, du] : {std::pair(0, 1), std::pair(1, 0)}) {
        if (v + dv >= inside.rows || u + du >= inside.cols) continue;
        if (distance_m(here, view.place_m.at<cv::Vec3f>(v + dv, u + du)) * 1000 > params.jump_mm)
          inside.at<uchar>(v, u) = inside.at<uchar>(v + dv, u + du) = 0;
      }
    }
  }
  cv::Mat away;
  cv::distanceTransform(inside, away, cv::DIST_L2, cv::DIST_MASK_5);
  return away <= params.fringe_px;
}

// What is collected of a region while the pixels pass.
struct Collected {
  double pixels = 0, height = 0, places = 0, exposed = 0, sleeve = 0, chest = 0, fringe = 0;
  std::size_t known = 0, unchanged = 0;
  std::vector<float> offsets;
};

void finish(RegionFacts& facts, Collected& of, double pixel_mm) {
  facts.area_mm2 = of.pixels * pixel_mm * pixel_mm;
  if (of.places > 0) facts.height_m = of.height / of.places;
  if (!of.offsets.empty()) facts.offset_mm = median(std::move(of.offsets));
  if (of.known >= kLeastKnown) facts.unchanged = static_cast<double>(of.unchanged) / static_cast<double>(of.known);
  facts.exposed = of.exposed / of.pixels;
  facts.sleeve = of.sleeve / of.pixels;
  facts.chest = of.chest / of.pixels;
  facts.fringe = of.fringe / of.pixels;
}

void collect(const ViewEvidence& view, int v, int u, uchar zone, Collected& into) {
  into.pixels += 1;
  into.sleeve += zone == kSleeve;
  into.chest += zone == kSureTop;
  into.exposed += exposed_skin(view, v, u) != ExposedSkin::none;
  if (const float y = view.place_m.at<cv::Vec3f>(v, u)[1]; !std::isnan(y)) into.height += y, into.places += 1;
  if (const float offset = view.offset_mm.at<float>(v, u); !std::isnan(offset)) into.offsets.push_back(offset);
  if (const float change = view.change.at<float>(v, u); !std::isnan(change))
    ++into.known, into.unchanged += change < kShadowUnits || view.shadow.at<uchar>(v, u);
}

// Regions of one view whose pixels lie side by side, without a jump of depth between them.
void touch_in_image(const ViewEvidence& view, const LabelMap& map, int first, double jump_mm,
                    std::vector<RegionFacts>& all) {
  for (int v = 0; v < map.labels.rows; ++v) {
    for (int u = 0; u < map.labels.cols; ++u) {
      const int here = map.labels.at<int>(v, u);
      for (const auto& [dv, du] : {std::pair(0, 1), std::pair(1, 0)}) {
        if (!here || v + dv >= map.labels.rows || u + du >= map.labels.cols) continue;
        const int there = map.labels.at<int>(v + dv, u + du);
        if (!there || there == here) continue;
        const double gap = distance_m(view.place_m.at<cv::Vec3f>(v, u), view.place_m.at<cv::Vec3f>(v + dv, u + du));
        if (gap * 1000 > jump_mm) continue;  // a place that is not known parts nothing
        all[first + here - 1].beside[first + there - 1] += 1;
        all[first + there - 1].beside[first + here - 1] += 1;
      }
    }
  }
}

// Regions of different views that are seen at the same place.
void touch_in_space(const std::vector<ViewEvidence>& views, const std::vector<LabelMap>& maps,
                    const std::vector<int>& first, double voxel_m, std::vector<RegionFacts>& all) {
  std::map<std::array<int, 3>, std::set<int>> seen;
  for (std::size_t k = 0; k < views.size(); ++k) {
    for (int v = 0; v < maps[k].labels.rows; ++v) {
      for (int u = 0; u < maps[k].labels.cols; ++u) {
        if (!maps[k].labels.at<int>(v, u) || !views[k].measured.at<uchar>(v, u)) continue;
        const auto& p = views[k].place_m.at<cv::Vec3f>(v, u);
        if (std::isnan(p[0])) continue;
        std::array<int, 3> voxel;
        for (int c = 0; c < 3; ++c) voxel[c] = static_cast<int>(std::floor(p[c] / voxel_m));
        seen[voxel].insert(first[k] + maps[k].labels.at<int>(v, u) - 1);
      }
    }
  }
  for (const auto& [voxel, regions] : seen)
    for (const int a : regions)
      for (const int b : regions)
        if (all[a].view != all[b].view) all[a].beside[b] += 1;
}

}  // namespace

void ColorSpread::add(const cv::Vec3d& luv, double times) {
  weight += times;
  sum += times * luv;
  squares += times * luv.mul(luv);
}

void ColorSpread::add(const ColorSpread& other) {
  weight += other.weight;
  sum += other.sum;
  squares += other.squares;
}

cv::Vec3d ColorSpread::deviation() const {
  const cv::Vec3d m = mean();
  cv::Vec3d result;
  for (int c = 0; c < 3; ++c) result[c] = std::sqrt(std::max(0.0, squares[c] / weight - m[c] * m[c]));
  return result;
}

double color_distance(const ColorSpread& a, const ColorSpread& b) {
  cv::Vec3d mean = a.mean() - b.mean(), deviation = a.deviation() - b.deviation();
  mean[0] *= kLightnessWeight;
  deviation[0] *= kLightnessWeight;
  return std::sqrt(mean.dot(mean) + deviation.dot(deviation));
}

std::vector<RegionFacts> region_facts(const std::vector<ViewEvidence>& views, const std::vector<LabelMap>& maps,
                                      const std::vector<cv::Mat>& luv, const Landmarks& limbs,
                                      const FactParams& params) {
  std::vector<cv::Mat> bodies;
  for (const ViewEvidence& view : views) bodies.push_back(view.body);
  const auto zones = cloth_zones(views, bodies, limbs);
  std::vector<RegionFacts> all;
  std::vector<int> first(views.size(), 0);
  for (std::size_t k = 0; k < views.size(); ++k) {
    first[k] = static_cast<int>(all.size());
    if (views[k].box.empty()) continue;
    const double pixel_mm = pixel_size_mm(views[k]);
    const cv::Mat fringe = fringe_of(views[k], params);
    std::vector<Collected> collected(static_cast<std::size_t>(maps[k].count));
    all.resize(all.size() + static_cast<std::size_t>(maps[k].count));
    for (int v = 0; v < fringe.rows; ++v) {
      for (int u = 0; u < fringe.cols; ++u) {
        const int label = maps[k].labels.at<int>(v, u);
        if (!label) continue;
        Collected& into = collected[label - 1];
        collect(views[k], v, u, zones[k].at<uchar>(v, u), into);
        into.fringe += fringe.at<uchar>(v, u) > 0;
        all[first[k] + label - 1].color.add(luv[k].at<cv::Vec3f>(v, u), pixel_mm * pixel_mm);
      }
    }
    for (int label = 1; label <= maps[k].count; ++label) {
      RegionFacts& facts = all[first[k] + label - 1];
      facts.view = k, facts.label = label;
      finish(facts, collected[label - 1], pixel_mm);
    }
    touch_in_image(views[k], maps[k], first[k], params.jump_mm, all);
  }
  touch_in_space(views, maps, first, params.voxel_m, all);
  return all;
}

}  // namespace dressform
