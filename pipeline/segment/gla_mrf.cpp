#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/segment/color_regions.h"
#include "pipeline/segment/jseg_colors.h"
#include "pipeline/segment/named_regions.h"

namespace dressform {
namespace {

constexpr double kLeastVariance = 4;  // squared L*u*v* units: noise of a photograph, however even a class is
const std::array<cv::Point, 8> kAround = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};

double squared_distance(const cv::Vec3f& a, const cv::Vec3f& b) {
  const cv::Vec3f d = a - b;
  return d.dot(d);
}

// Mean squared distance of a class's pixels from its colour, by channel.
std::vector<double> variances(const cv::Mat& luv, const ColorClasses& colors) {
  std::vector<double> sums(colors.luv.size(), 0);
  std::vector<int> counts(colors.luv.size(), 0);
  for (int y = 0; y < luv.rows; ++y)
    for (int x = 0; x < luv.cols; ++x)
      if (const int k = colors.classes.at<int>(y, x); k >= 0)
        sums[k] += squared_distance(luv.at<cv::Vec3f>(y, x), colors.luv[k]) / 3, ++counts[k];
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] = std::max(kLeastVariance, sums[k] / std::max(1, counts[k]));
  return sums;
}

// One sweep in reading order: every pixel takes the class of least cost, by its colour and by its neighbours' classes
// as they are then. How many changed.
int sweep(const cv::Mat& luv, const ColorClasses& colors, const std::vector<double>& variance, double smoothness,
          cv::Mat& classes) {
  const cv::Rect image({0, 0}, luv.size());
  std::vector<double> costs(colors.luv.size());
  int changed = 0;
  for (int y = 0; y < luv.rows; ++y)
    for (int x = 0; x < luv.cols; ++x) {
      int& here = classes.at<int>(y, x);
      if (here < 0) continue;
      for (std::size_t k = 0; k < costs.size(); ++k)
        costs[k] =
            squared_distance(luv.at<cv::Vec3f>(y, x), colors.luv[k]) / (2 * variance[k]) + 1.5 * std::log(variance[k]);
      for (const cv::Point& step : kAround) {
        const cv::Point to = cv::Point(x, y) + step;
        if (!image.contains(to)) continue;
        if (const int other = classes.at<int>(to); other >= 0) costs[other] -= smoothness;
      }
      const int best = static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin());
      changed += best != here;
      here = best;
    }
  return changed;
}

}  // namespace

LabelMap gla_mrf_regions(const cv::Mat& bgr, const cv::Mat& mask, double scale, const GlaMrfParams& params) {
  if (cv::countNonZero(mask) == 0) return {cv::Mat::zeros(mask.size(), CV_32S), 0};
  const cv::Mat luv = luv_of(bgr);
  QuantizeParams quantize;
  quantize.threshold = params.threshold;
  // Every pixel counts the same: peer groups are JSEG's.
  const ColorClasses colors = quantized({luv, cv::Mat::zeros(luv.size(), CV_32F)}, mask, quantize);
  cv::Mat classes = colors.classes.clone();
  const auto variance = variances(luv, colors);
  for (int k = 0; k < params.sweeps; ++k)
    if (sweep(luv, colors, variance, params.smoothness, classes) == 0) break;
  return pieces_of_keys(classes + 1, std::max(1, cvRound(params.least_px * scale * scale)));
}

namespace {

struct GlaMrfVariantParams {
  GlaMrfParams regions;
  NamedRegionParams naming;
};
template <class V>
void fields(V& v, GlaMrfVariantParams& p) {
  v("color_threshold", p.regions.threshold, 0, 600, "",
    "squared L*u*v* distance up to which colours are one class; 0: found between 260 and 400");
  v("smoothness", p.regions.smoothness, 0, 20, "nats", "price of a pair of neighbours of different classes");
  v("sweeps", p.regions.sweeps, 0, 100, "", "over the image, at most");
  v("least_px", p.regions.least_px, 1, 100000, "px", "of a region, at 1920 x 1080; smaller ones join those round them");
  naming_fields(v, p.naming);
}

// Classes of colours by the generalised Lloyd algorithm (Linde, Buzo and Gray, "An algorithm for vector quantizer
// design", IEEE Trans. Communications 1980), each a normal distribution, made even by a Markov random field that prices
// neighbours of different classes (Geman and Geman, PAMI 1984), its modes iterated (Besag, "On the statistical analysis
// of dirty pictures", JRSS B 1986). Named by the naked body.
Segmentation gla_mrf(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                     const ExtractedViews& extracted, const Registration& registration,
                     const GlaMrfVariantParams& params) {
  const auto find = [&](const cv::Mat& bgr, const cv::Mat& body, double scale) {
    return gla_mrf_regions(bgr, body, scale, params.regions);
  };
  return named_regions(session, calibration, naked, extracted, registration, "segment.gla_mrf", find, params.naming);
}

const Segment::Variant gla_mrf_variant{"gla_mrf", gla_mrf};

}  // namespace
}  // namespace dressform
