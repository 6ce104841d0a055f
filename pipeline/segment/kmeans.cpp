#include <algorithm>
#include <opencv2/core.hpp>

#include "pipeline/imaging/color_histogram.h"
#include "pipeline/imaging/seeded_rng.h"
#include "pipeline/segment/color_regions.h"
#include "pipeline/segment/named_regions.h"

namespace dressform {

LabelMap kmeans_regions(const cv::Mat& bgr, const cv::Mat& mask, double scale, const KmeansParams& params, Seed seed) {
  constexpr double kStill = 1;  // 8-bit units of Lab: centres that move by less have settled
  const cv::Mat lab = smoothed_lab(bgr);
  std::vector<cv::Vec3f> colors;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask.at<uchar>(y, x)) colors.emplace_back(lab.at<cv::Vec3b>(y, x));
  cv::Mat keys = cv::Mat::zeros(mask.size(), CV_32S);
  if (static_cast<int>(colors.size()) < params.clusters) return {keys, 0};
  cv::Mat classes;
  {
    const SeededRng seeded(seed);
    const cv::TermCriteria until(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, params.iterations, kStill);
    cv::kmeans(cv::Mat(colors).reshape(1, static_cast<int>(colors.size())), params.clusters, classes, until,
               params.attempts, cv::KMEANS_PP_CENTERS);
  }
  int i = 0;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask.at<uchar>(y, x)) keys.at<int>(y, x) = classes.at<int>(i++) + 1;
  return pieces_of_keys(keys, std::max(1, cvRound(params.least_px * scale * scale)));
}

namespace {

struct KmeansVariantParams {
  KmeansParams regions;
  NamedRegionParams naming;
};
template <class V>
void fields(V& v, KmeansVariantParams& p) {
  v("clusters", p.regions.clusters, 2, 64, "", "of colours in each view");
  v("attempts", p.regions.attempts, 1, 50, "", "from other centres, of which the most compact is kept");
  v("iterations", p.regions.iterations, 1, 200, "", "of each attempt");
  v("least_px", p.regions.least_px, 1, 100000, "px", "of a region, at 1920 x 1080; smaller ones join those round them");
  naming_fields(v, p.naming);
}

// Every view's colours in a few clusters, whose connected pieces are the regions (Lloyd, "Least squares quantization in
// PCM", 1982; started by Arthur and Vassilvitskii, "k-means++", SODA 2007), by OpenCV, named by the naked body. Where
// pixels lie says nothing here.
Segmentation kmeans(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                    const ExtractedViews& extracted, const Registration& registration,
                    const KmeansVariantParams& params, Seed seed) {
  const auto find = [&](const cv::Mat& bgr, const cv::Mat& body, double scale) {
    return kmeans_regions(bgr, body, scale, params.regions, seed);
  };
  return named_regions(session, calibration, naked, extracted, registration, "segment.kmeans", find, params.naming);
}

const Segment::Variant kmeans_variant{"kmeans", kmeans};

}  // namespace
}  // namespace dressform
