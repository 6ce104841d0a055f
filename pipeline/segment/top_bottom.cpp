#include "pipeline/segment/top_bottom.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/common/graph_cut.h"
#include "pipeline/segment/hem_curve.h"
#include "pipeline/segment/view_models.h"

namespace dressform {
namespace {

constexpr int kColumns = 72;
constexpr double kRow_m = 0.005;
constexpr float kSleeveEnd = 0.7f;  // of the arm: cloth above is sleeve, below it may hang from the hips
constexpr float kBinNats = 6;       // most that one cell of the curve's grid says
constexpr float kFullCell = 6;      // pixels from which a cell counts in full
constexpr float kSeedNats = 4;      // of a cell that is surely top or bottom

enum Zone : uchar { kNowhere, kBetween, kSureTop, kSureBottom, kSleeve };

class Divider {
 public:
  Divider(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& cloth, const BodyLimbs& limbs,
          const TopBottomParams& params)
      : views_(views), cloth_(cloth), limbs_(limbs), params_(params) {
    rows_ = std::max(8, static_cast<int>(std::ceil((limbs.top_y - limbs.floor_y + 0.1) / kRow_m)));
    find_axis();
    mark_zones();
  }

  TopBottom run() {
    TopBottom result;
    result.has_top = area_mm2(kSureTop) >= params_.least_mm2;
    result.has_bottom = area_mm2(kSureBottom) >= params_.least_mm2;
    if (result.has_top && result.has_bottom) {
      trace();
    } else {
      hem_.assign(kColumns, result.has_bottom ? rows_ : 0);
    }
    result.top.resize(views_.size());
    result.bottom.resize(views_.size());
    tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t k) {
      if (views_[k].box.empty()) return;
      result.top[k] = result.has_top && result.has_bottom ? redrawn(k) : one_garment(k, result.has_top);
      result.bottom[k] = cloth_[k] & ~result.top[k];
      if (!result.has_top) result.top[k].setTo(0);
      if (!result.has_bottom) result.bottom[k].setTo(0);
    });
    return result;
  }

 private:
  template <class Visit>
  void each_cloth_pixel(std::size_t k, const Visit& visit) const {
    for (int v = 0; v < views_[k].box.height; ++v)
      for (int u = 0; u < views_[k].box.width; ++u)
        if (cloth_[k].at<uchar>(v, u) && !std::isnan(views_[k].place_m.at<cv::Vec3f>(v, u)[0])) visit(v, u);
  }

  // The upright axis of the hips: directions are counted round it.
  void find_axis() {
    axis_ = limbs_.neck;
    if (limbs_.left_leg && limbs_.right_leg) axis_ = (limbs_.left_leg->root + limbs_.right_leg->root) / 2;
  }

  int column(const cv::Vec3f& place) const {
    const double angle = std::atan2(place[0] - axis_.x(), place[2] - axis_.z()) + M_PI;
    return std::clamp(static_cast<int>(angle / (2 * M_PI) * kColumns), 0, kColumns - 1);
  }
  int row(const cv::Vec3f& place) const {
    return std::clamp(static_cast<int>((place[1] - limbs_.floor_y) / kRow_m), 0, rows_ - 1);
  }

  // Cloth low on the legs, whatever its length: the lower 60 % of what hangs more than a hand below the crotch.
  double sure_bottom_height() const {
    double lowest = limbs_.crotch_y;
    std::vector<float> heights;
    for (std::size_t k = 0; k < views_.size(); ++k) {
      each_cloth_pixel(k, [&](int v, int u) {
        const float y = views_[k].place_m.at<cv::Vec3f>(v, u)[1];
        if (y < limbs_.crotch_y) heights.push_back(y);
      });
    }
    if (!heights.empty()) {
      std::nth_element(heights.begin(), heights.begin() + heights.size() / 50, heights.end());
      lowest = heights[heights.size() / 50];
    }
    const double hand = 0.05 * (limbs_.top_y - limbs_.floor_y);
    return std::min(limbs_.crotch_y - hand, lowest + 0.6 * (limbs_.crotch_y - lowest));
  }

  void mark_zones() {
    const double chest = limbs_.armpit_y - 0.04 * (limbs_.top_y - limbs_.floor_y), low = sure_bottom_height();
    zones_.resize(views_.size());
    for (std::size_t k = 0; k < views_.size(); ++k) {
      if (views_[k].box.empty()) continue;
      zones_[k] = cv::Mat::zeros(views_[k].box.size(), CV_8U);
      each_cloth_pixel(k, [&](int v, int u) {
        const auto part = static_cast<BodyPart>(views_[k].part.at<uchar>(v, u));
        const float y = views_[k].place_m.at<cv::Vec3f>(v, u)[1];
        const bool arm = part == BodyPart::left_arm || part == BodyPart::right_arm;
        Zone zone = kBetween;
        if (arm && views_[k].limb_end.at<float>(v, u) < kSleeveEnd && y > limbs_.crotch_y)
          zone = kSleeve;
        else if (y > chest)
          zone = kSureTop;
        else if (y < low && !arm)
          zone = kSureBottom;
        zones_[k].at<uchar>(v, u) = zone;
      });
    }
  }

  double area_mm2(Zone zone) const {
    double area = 0;
    for (std::size_t k = 0; k < views_.size(); ++k)
      if (!zones_[k].empty()) area += cv::countNonZero(zones_[k] == zone) * std::pow(pixel_size_mm(views_[k]), 2);
    return area;
  }

  void trace() {
    std::vector<cv::Mat> top(views_.size()), bottom(views_.size());
    for (std::size_t k = 0; k < views_.size(); ++k) {
      if (zones_[k].empty()) continue;
      top[k] = eroded((zones_[k] == kSureTop) | (zones_[k] == kSleeve), 1);
      bottom[k] = eroded(zones_[k] == kSureBottom, 1);
    }
    for (int round = 0; round < params_.rounds; ++round) {
      weigh_colors(top, bottom);
      hem_ = trace_hem(gathered_nats(), params_.row_price);
      for (std::size_t k = 0; k < views_.size(); ++k)
        if (!zones_[k].empty()) split_by_curve(k, 0.02, top[k], bottom[k]);
    }
    weigh_colors(top, bottom);
  }

  // Per pixel, the colour's nats in favour of top.
  void weigh_colors(const std::vector<cv::Mat>& top, const std::vector<cv::Mat>& bottom) {
    const auto images = lab_images(views_);
    const auto top_colors = shared_models(top, images), bottom_colors = shared_models(bottom, images);
    const auto most = static_cast<float>(params_.color_nats);
    nats_.assign(views_.size(), cv::Mat());
    tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t k) {
      if (views_[k].box.empty()) return;
      nats_[k] = cv::Mat::zeros(views_[k].box.size(), CV_32F);
      for (int v = 0; v < nats_[k].rows; ++v) {
        for (int u = 0; u < nats_[k].cols; ++u) {
          if (!cloth_[k].at<uchar>(v, u)) continue;
          const auto& color = views_[k].lab.at<cv::Vec3b>(v, u);
          nats_[k].at<float>(v, u) =
              std::clamp(top_colors[k].log_density(color) - bottom_colors[k].log_density(color), -most, most);
        }
      }
    });
  }

  // All views' nats on the grid of directions and heights.
  cv::Mat gathered_nats() const {
    cv::Mat sum = cv::Mat::zeros(rows_, kColumns, CV_32F), count = sum.clone(), seed = sum.clone();
    for (std::size_t k = 0; k < views_.size(); ++k) {
      each_cloth_pixel(k, [&](int v, int u) {
        const uchar zone = zones_[k].at<uchar>(v, u);
        if (zone == kSleeve) return;
        const auto& place = views_[k].place_m.at<cv::Vec3f>(v, u);
        const int r = row(place), c = column(place);
        sum.at<float>(r, c) += nats_[k].at<float>(v, u);
        count.at<float>(r, c) += 1;
        if (zone != kBetween) seed.at<float>(r, c) = zone == kSureTop ? kSeedNats : -kSeedNats;
      });
    }
    cv::Mat nats = seed;
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < kColumns; ++c) {
        const float pixels = count.at<float>(r, c);
        if (pixels == 0) continue;
        const float full = std::min(1.f, pixels / kFullCell);
        nats.at<float>(r, c) += std::clamp(sum.at<float>(r, c) / pixels * 2 * full, -kBinNats, kBinNats);
      }
    }
    return nats;
  }

  // Metres above the curve.
  float above(const cv::Vec3f& place) const {
    return static_cast<float>(place[1] - limbs_.floor_y - hem_[column(place)] * kRow_m);
  }

  void split_by_curve(std::size_t k, float margin_m, cv::Mat& top, cv::Mat& bottom) const {
    top = cv::Mat::zeros(views_[k].box.size(), CV_8U);
    bottom = top.clone();
    each_cloth_pixel(k, [&](int v, int u) {
      const float height = above(views_[k].place_m.at<cv::Vec3f>(v, u));
      const bool sleeve = zones_[k].at<uchar>(v, u) == kSleeve;
      if (sleeve || height > margin_m) top.at<uchar>(v, u) = 255;
      if (!sleeve && height < -margin_m) bottom.at<uchar>(v, u) = 255;
    });
    top = eroded(top, 1);
    bottom = eroded(bottom, 1);
  }

  // The curve's division of one view, moved to the edges of the picture.
  cv::Mat redrawn(std::size_t k) const {
    const ViewEvidence& view = views_[k];
    cv::Mat initial = cv::Mat::zeros(view.box.size(), CV_8U), active = initial.clone();
    cv::Mat cost = cv::Mat::zeros(view.box.size(), CV_32F);
    const auto band_m = static_cast<float>(params_.band_mm / 1000);
    for (int v = 0; v < initial.rows; ++v) {
      for (int u = 0; u < initial.cols; ++u) {
        if (!cloth_[k].at<uchar>(v, u)) continue;
        const auto& place = view.place_m.at<cv::Vec3f>(v, u);
        if (std::isnan(place[0])) {  // no place near: colours and neighbours alone
          active.at<uchar>(v, u) = 255;
          cost.at<float>(v, u) = -nats_[k].at<float>(v, u);
          continue;
        }
        const float height = above(place);
        const bool sleeve = zones_[k].at<uchar>(v, u) == kSleeve;
        if (sleeve || height > 0) initial.at<uchar>(v, u) = 255;
        if (sleeve || std::abs(height) > band_m) continue;
        active.at<uchar>(v, u) = 255;
        cost.at<float>(v, u) = -nats_[k].at<float>(v, u) - 4 * height / band_m;
      }
    }
    fade(initial, cloth_[k]);
    cv::Mat cut = binary_cut(view.lab, cost, active, initial, {params_.smoothness, 0.02}) & cloth_[k];
    remove_specks(cut, cloth_[k], params_.speck_mm2, pixel_size_mm(view));
    return cut;
  }

  // Outside the cloth, the label of the cloth nearby: its outline costs nothing.
  static void fade(cv::Mat& mask, const cv::Mat& inside) {
    cv::Mat grown;
    cv::dilate(mask & inside, grown, cv::Mat(), {-1, -1}, 2);
    grown.copyTo(mask, inside == 0);
  }

  cv::Mat one_garment(std::size_t k, bool top) const {
    return top ? cloth_[k].clone() : cv::Mat(cv::Mat::zeros(views_[k].box.size(), CV_8U));
  }

  const std::vector<ViewEvidence>& views_;
  const std::vector<cv::Mat>& cloth_;
  const BodyLimbs& limbs_;
  const TopBottomParams& params_;
  int rows_ = 0;
  Vector3d axis_ = Vector3d::Zero();
  std::vector<cv::Mat> zones_, nats_;
  std::vector<int> hem_;
};

}  // namespace

TopBottom part_cloth(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& cloth, const BodyLimbs& limbs,
                     const TopBottomParams& params) {
  return Divider(views, cloth, limbs, params).run();
}

}  // namespace dressform
