#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "pipeline/segment/color_regions.h"
#include "pipeline/segment/named_regions.h"
#include "scenes/disjoint_sets.h"

namespace dressform {

namespace {

// Neighbours whose filtered colours differ by at most `join` in every channel are one: cv::floodFill's rule, for all
// pixels at once.
cv::Mat joined_colors(const cv::Mat& luv, const cv::Mat& mask, double join) {
  DisjointSets sets(luv.total());
  const auto one = [&](int y, int x, int v, int u) {
    if (v >= luv.rows || u >= luv.cols || !mask.at<uchar>(y, x) || !mask.at<uchar>(v, u)) return;
    const auto &a = luv.at<cv::Vec3b>(y, x), &b = luv.at<cv::Vec3b>(v, u);
    for (int c = 0; c < 3; ++c)
      if (std::abs(a[c] - b[c]) > join) return;
    sets.join(y * luv.cols + x, v * luv.cols + u);
  };
  for (int y = 0; y < luv.rows; ++y)
    for (int x = 0; x < luv.cols; ++x) one(y, x, y, x + 1), one(y, x, y + 1, x);
  cv::Mat keys = cv::Mat::zeros(luv.size(), CV_32S);
  for (int y = 0; y < luv.rows; ++y)
    for (int x = 0; x < luv.cols; ++x)
      if (mask.at<uchar>(y, x)) keys.at<int>(y, x) = sets.root(y * luv.cols + x) + 1;
  return keys;
}

}  // namespace

LabelMap mean_shift_regions(const cv::Mat& bgr, const cv::Mat& mask, double scale, const MeanShiftParams& params) {
  constexpr double kLeastRadius_px = 3;  // a window of fewer pixels has no density to follow
  cv::Mat luv, filtered;
  cv::cvtColor(bgr, luv, cv::COLOR_BGR2Luv);
  cv::pyrMeanShiftFiltering(luv, filtered, std::max(kLeastRadius_px, params.spatial_px * scale), params.color,
                            params.levels);
  return pieces_of_keys(joined_colors(filtered, mask, params.join),
                        std::max(1, cvRound(params.least_px * scale * scale)));
}

namespace {

struct MeanShiftVariantParams {
  MeanShiftParams regions;
  NamedRegionParams naming;
};
template <class V>
void fields(V& v, MeanShiftVariantParams& p) {
  v("spatial_px", p.regions.spatial_px, 1, 100, "px", "radius of the window in the image, at 1920 x 1080");
  v("color", p.regions.color, 1, 100, "", "radius of the window in colour, L*u*v* of 8 bits");
  v("levels", p.regions.levels, 0, 4, "", "of the pyramid, above the image itself");
  v("join", p.regions.join, 0, 50, "", "largest step of a channel between neighbours of one region, after filtering");
  v("least_px", p.regions.least_px, 1, 100000, "px", "of a region, at 1920 x 1080; smaller ones join those round them");
  naming_fields(v, p.naming);
}

// Regions of even colour by mean shift (Comaniciu and Meer, "Mean shift: a robust approach toward feature space
// analysis", PAMI 2002) as OpenCV filters by it, with the radii of OpenCV's own example, named by the naked body.
Segmentation mean_shift(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                        const ExtractedViews& extracted, const Registration& registration,
                        const MeanShiftVariantParams& params) {
  const auto find = [&](const cv::Mat& bgr, const cv::Mat& body, double scale) {
    return mean_shift_regions(bgr, body, scale, params.regions);
  };
  return named_regions(session, calibration, naked, extracted, registration, "segment.mean_shift", find, params.naming);
}

const Segment::Variant mean_shift_variant{"mean_shift", mean_shift};

}  // namespace
}  // namespace dressform
