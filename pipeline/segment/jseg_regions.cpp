#include "pipeline/segment/jseg_regions.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "pipeline/segment/jseg_growing.h"
#include "pipeline/segment/jseg_merging.h"
#include "scenes/error.h"

namespace dressform {
namespace {

// Where `merge` leaves one region for all, this is tried: pieces of one texture are nearer than that, parts of a
// photograph of little contrast seldom are.
constexpr double kFineMerge = 0.2;

// The scale that fits a region: the largest whose regions are not larger, at least 1; 0 where it can't hold two
// valleys.
int fitting_scale(int pixels) {
  if (pixels < 2 * least_valley_px(1)) return 0;
  int scale = 1;
  while (scale < kJsegScales && pixels >= least_region_px(scale + 1)) ++scale;
  return scale;
}

std::vector<int> sizes_of(const LabelMap& map) {
  std::vector<int> sizes(static_cast<std::size_t>(map.count) + 1, 0);
  for (int y = 0; y < map.labels.rows; ++y)
    for (int x = 0; x < map.labels.cols; ++x) ++sizes[map.labels.at<int>(y, x)];
  return sizes;
}

// The regions of a pass, and the scale at which each was parted.
struct Parted {
  LabelMap map;
  std::vector<int> scale;  // by label
};

// The pixels of the regions that are parted at `scale`.
cv::Mat of_scale(const Parted& regions, int scale) {
  cv::Mat chosen = cv::Mat::zeros(regions.map.labels.size(), CV_32S);
  for (int y = 0; y < chosen.rows; ++y)
    for (int x = 0; x < chosen.cols; ++x)
      if (const int label = regions.map.labels.at<int>(y, x); label && regions.scale[label] == scale)
        chosen.at<int>(y, x) = label;
  return chosen;
}

struct Pass {
  std::vector<cv::Mat> j;
  cv::Mat valleys;
  int valley_count = 0;
};

// Every region parted at its scale; what is parted at scale s is ready for s - 1 next.
Parted part(const Parted& before, const ColorClasses& colors, Pass& pass) {
  Parted after{{before.map.labels.clone(), 0}, {0}};
  pass.valleys = cv::Mat::zeros(before.map.labels.size(), CV_32S);
  for (int scale = kJsegScales; scale >= 0; --scale) {
    const cv::Mat chosen = of_scale(before, scale);
    if (cv::countNonZero(chosen) == 0) continue;
    LabelMap parts = scale == 0 ? connected_pieces(chosen) : LabelMap{};
    if (scale > 0) {
      std::vector<cv::Mat> j;
      for (int s = 1; s <= scale; ++s) j.push_back(j_image(colors.classes, colors.count(), chosen, s));
      const LabelMap found = valleys(j[scale - 1], chosen, scale);
      parts = grown(found, chosen, j, scale);
      for (int s = 1; s <= scale; ++s) {
        if (static_cast<int>(pass.j.size()) < s) pass.j.push_back(cv::Mat::zeros(chosen.size(), CV_32F));
        j[s - 1].copyTo(pass.j[s - 1], chosen != 0);
      }
      cv::Mat(found.labels + pass.valley_count).copyTo(pass.valleys, found.labels != 0);
      pass.valley_count += found.count;
    }
    cv::Mat(parts.labels + after.map.count).copyTo(after.map.labels, chosen != 0);
    after.map.count += parts.count;
    after.scale.resize(static_cast<std::size_t>(after.map.count) + 1, scale);
  }
  return after;
}

// One finer scale for regions that are large enough for it and uneven by themselves: a texture that looks alike all
// over would come apart into its elements. None for the others; J, which costs most, is not asked of those too small.
void go_finer(Parted& regions, const ColorClasses& colors, double uneven) {
  const auto sizes = sizes_of(regions.map);
  for (int label = 1; label <= regions.map.count; ++label)
    if (const int scale = regions.scale[label]; scale < 2 || sizes[label] < least_region_px(scale - 1))
      regions.scale[label] = 0;
  std::vector<double> sums(sizes.size(), 0);
  for (int scale = 2; scale <= kJsegScales; ++scale) {
    const cv::Mat chosen = of_scale(regions, scale);
    if (cv::countNonZero(chosen) == 0) continue;
    const cv::Mat j = j_image(colors.classes, colors.count(), chosen, scale);
    for (int y = 0; y < j.rows; ++y)
      for (int x = 0; x < j.cols; ++x) sums[chosen.at<int>(y, x)] += j.at<float>(y, x);
  }
  for (int label = 1; label <= regions.map.count; ++label) {
    int& scale = regions.scale[label];
    scale = scale > 0 && sums[label] > uneven * sizes[label] ? scale - 1 : 0;
  }
}

cv::Mat checked_mask(const cv::Mat& bgr, const cv::Mat& mask) {
  if (bgr.type() != CV_8UC3 || bgr.empty()) throw InputError("jseg", "expected an 8-bit BGR image with pixels");
  if (mask.empty()) return cv::Mat(bgr.size(), CV_8U, cv::Scalar(255));
  if (mask.type() != CV_8U || mask.size() != bgr.size())
    throw InputError("jseg", "expected an 8-bit mask of the image's size");
  return mask;
}

}  // namespace

JsegResult jseg(const cv::Mat& bgr, const cv::Mat& mask, const JsegParams& params) {
  const cv::Mat inside = checked_mask(bgr, mask);
  JsegResult result;
  result.colors = quantized(peer_group_filtered(luv_of(bgr), inside), inside, params.colors);

  Parted regions;
  cv::Mat whole;
  cv::Mat(inside != 0).convertTo(whole, CV_32S, 1 / 255.0);
  regions.map = connected_pieces(whole);
  for (const int pixels : sizes_of(regions.map)) regions.scale.push_back(fitting_scale(pixels));
  for (int round = 0; round < params.scales; ++round) {
    Pass pass;
    if (round > 0) go_finer(regions, result.colors, params.uneven);
    regions = part(regions, result.colors, pass);
    if (round > 0) continue;
    result.j = std::move(pass.j);
    result.valleys = pass.valleys;
    result.valley_count = pass.valley_count;
  }
  result.unmerged = regions.map.labels;
  result.unmerged_count = regions.map.count;

  LabelMap last = merged(regions.map, result.colors.classes, result.colors.count(), params.merge);
  if (last.count == 1 && params.merge > kFineMerge)
    last = merged(regions.map, result.colors.classes, result.colors.count(), kFineMerge);
  result.regions = last.labels;
  result.region_count = last.count;
  return result;
}

}  // namespace dressform
