#include "pipeline/extract/color_outline.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "pipeline/imaging/color_histogram.h"
#include "pipeline/imaging/color_mapping.h"
#include "pipeline/imaging/graph_cut.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr int kBlocks = 12;                           // colour models along the body's height
constexpr double kLeastPiece = 0.01;                  // of the mask's area
constexpr float kMostNats = 4;                        // of one cue
constexpr float kColorNats = 2;                       // of the colour models, which confuse skin and a wall alike
constexpr float kBandNats = 3;                        // of a pixel a band's width off the depth's outline
constexpr double kLeastNoise = 1.5, kUsualNoise = 2;  // levels by which an unchanged pixel differs
constexpr float kChanged = 4;                         // times that noise: neither for nor against
constexpr double kEdgeFloor = 0.05;                   // of the smoothness that is paid even across a strong edge

cv::Mat ellipse(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radius + 1, 2 * radius + 1));
}

// Pixels from the outline: negative inside the mask, positive outside.
cv::Mat signed_distance_px(const cv::Mat& mask) {
  cv::Mat inside, outside;
  cv::distanceTransform(mask, inside, cv::DIST_L2, 5);
  cv::distanceTransform(255 - mask, outside, cv::DIST_L2, 5);
  return outside - inside;
}

struct LocalModels {
  std::vector<ColorHistogram> body, around;  // by block of rows
  int rows_per_block = 1;
};

LocalModels learn(const cv::Mat& lab, const cv::Mat& sure_body, const cv::Mat& sure_around) {
  LocalModels models;
  models.rows_per_block = std::max(1, (lab.rows + kBlocks - 1) / kBlocks);
  for (int block = 0; block < kBlocks; ++block) {
    const int from = std::max(0, (block - 1) * models.rows_per_block);
    const int to = std::min(lab.rows, (block + 2) * models.rows_per_block);
    models.body.emplace_back();
    models.around.emplace_back();
    if (from >= to) continue;
    const cv::Range rows(from, to);
    models.body.back().add(lab.rowRange(rows), sure_body.rowRange(rows));
    models.around.back().add(lab.rowRange(rows), sure_around.rowRange(rows));
    models.body.back().finish();
    models.around.back().finish();
  }
  return models;
}

cv::Mat color_distance(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat smooth_a, smooth_b, difference, channels[3], distance;
  cv::GaussianBlur(a, smooth_a, cv::Size(3, 3), 0);
  cv::GaussianBlur(b, smooth_b, cv::Size(3, 3), 0);
  cv::absdiff(smooth_a, smooth_b, difference);
  cv::split(difference, channels);
  cv::max(channels[0], channels[1], distance);
  cv::max(distance, channels[2], distance);
  return distance;  // uint8
}

// Median of the values where mask != 0; `otherwise` when there are none.
double median_of(const cv::Mat& values, const cv::Mat& mask, double otherwise) {
  std::vector<uchar> kept;
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < values.cols; ++x)
      if (mask.at<uchar>(y, x)) kept.push_back(values.at<uchar>(y, x));
  return kept.empty() ? otherwise : median(std::move(kept));
}

// Nats in favour of the surroundings where the image equals the one without clothes.
void add_unchanged(const cv::Mat& bgr, const Background& background, const cv::Mat& around, int margin_px,
                   cv::Mat& cost) {
  const cv::Mat change = color_distance(bgr, background.bgr);
  // Near the naked body's outline, bare skin is unchanged too.
  cv::Mat near_body;
  cv::dilate(background.body, near_body, ellipse(margin_px));
  cv::Mat visible = around & (near_body == 0);
  const double noise = std::max(kLeastNoise, median_of(change, visible, kUsualNoise));
  for (int y = 0; y < cost.rows; ++y) {
    for (int x = 0; x < cost.cols; ++x) {
      if (near_body.at<uchar>(y, x)) continue;
      const float nats = kMostNats * (1 - change.at<uchar>(y, x) / static_cast<float>(kChanged * noise));
      cost.at<float>(y, x) += std::clamp(nats, -kMostNats, kMostNats);
    }
  }
}

// Cost of "body" less cost of "not body" from colours and from the distance to the depth's outline.
cv::Mat color_cost(const cv::Mat& lab, const LocalModels& models, const cv::Mat& distance_px, double band_px) {
  cv::Mat cost(lab.size(), CV_32F);
  for (int y = 0; y < lab.rows; ++y) {
    const int block = std::min(kBlocks - 1, y / models.rows_per_block);
    for (int x = 0; x < lab.cols; ++x) {
      const auto& color = lab.at<cv::Vec3b>(y, x);
      const float nats = models.around[block].log_density(color) - models.body[block].log_density(color);
      const float away = distance_px.at<float>(y, x) / static_cast<float>(band_px);
      cost.at<float>(y, x) =
          std::clamp(nats, -kColorNats, kColorNats) + std::clamp(kBandNats * away, -kMostNats, kMostNats);
    }
  }
  return cost;
}

// Drops pieces that are a small part of the whole: bits of stand and furniture beside the feet.
void keep_large_pieces(cv::Mat& mask) {
  cv::Mat labels, stats, centers;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centers, 8);
  const double least = kLeastPiece * cv::countNonZero(mask);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label > 0 && label < count && stats.at<int>(label, cv::CC_STAT_AREA) < least) mask.at<uchar>(y, x) = 0;
    }
  }
}

cv::Rect grown_box(const cv::Mat& mask, int margin) {
  const cv::Rect box = cv::boundingRect(mask);
  return cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
         cv::Rect({0, 0}, mask.size());
}

}  // namespace

cv::Mat color_outline(const cv::Mat& bgr, const cv::Mat& depth_mm, const cv::Mat& mask, const SensorCalibration& sensor,
                      const OutlineParams& params, const Background* background) {
  const ColorDepthMap map = color_depth_map(depth_mm, sensor);
  cv::Mat known = map.depth_mm > 0, body = to_color(mask, map);
  cv::Mat result = cv::Mat::zeros(bgr.size(), CV_8U);
  if (cv::countNonZero(body) == 0) return result;
  const double scale = sensor.color->width / 1920.0;
  // The outermost depth pixels are lost to mixing: the true outline lies about half a depth pixel further out.
  const double lost_px = 0.5 * sensor.color->fx / sensor.ir.fx;
  const int band = std::max(2, cvRound(params.band_px * scale)),
            unknown = std::max(4, cvRound(params.unknown_px * scale));
  cv::morphologyEx(body, body, cv::MORPH_CLOSE, ellipse(std::max(1, band / 2)));

  const cv::Rect box = grown_box(body, 3 * unknown);
  known = known(box).clone();
  body = body(box).clone();
  const cv::Mat distance_px = signed_distance_px(body) - lost_px;
  const cv::Mat near = cv::abs(distance_px) < band;
  const cv::Mat active = near | ((distance_px > 0) & (distance_px < unknown) & (known == 0));
  const cv::Mat sure_body = distance_px < -band, around = (distance_px > band) & (distance_px < 3 * unknown) & ~active;

  const cv::Mat lab = smoothed_lab(bgr(box));
  cv::Mat cost = color_cost(lab, learn(lab, sure_body, around), distance_px, band);
  if (background) add_unchanged(bgr(box), {background->bgr(box), background->body(box)}, around, band, cost);
  cv::Mat cut = binary_cut(lab, cost, active, body, {params.smoothness, kEdgeFloor});
  cv::morphologyEx(cut, cut, cv::MORPH_OPEN, ellipse(1));
  // Bites into the outline that depth does not show: a print of the wall's colour.
  cv::Mat closed;
  cv::morphologyEx(cut, closed, cv::MORPH_CLOSE, ellipse(band));
  closed.copyTo(cut, (known == 0) & (cost < kMostNats / 2));
  keep_large_pieces(cut);
  cut.copyTo(result(box));
  return result;
}

}  // namespace dressform
