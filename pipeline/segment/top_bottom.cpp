#include "pipeline/segment/top_bottom.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/imaging/graph_cut.h"
#include "pipeline/segment/bottom_kind.h"
#include "pipeline/segment/cloth_zones.h"
#include "pipeline/segment/hem_curve.h"
#include "pipeline/segment/hem_edges.h"
#include "pipeline/segment/hem_evidence.h"
#include "pipeline/segment/trunk_grid.h"
#include "pipeline/segment/view_models.h"

namespace dressform {
namespace {

constexpr float kBinNats = 6;            // most that one cell of the curve's grid says
constexpr float kFullCell = 6;           // pixels from which a cell counts in full
constexpr float kSeedNats = 4;           // of a cell that is surely top or bottom
constexpr double kPlainNats = 2.5;       // no other curve can tell the colours much better
constexpr int kOffPlane_rows = 14;       // that a hem may lie from the plane through it
constexpr double kLeastSeed_mm2 = 1500;  // of cloth to learn the bottom's colours from

class HemBoundarySearch {
 public:
  HemBoundarySearch(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& cloth, const BodyLimbs& limbs,
                    const TopBottomParams& params)
      : views_(views),
        cloth_(cloth),
        limbs_(limbs),
        params_(params),
        grid_(limbs),
        zones_(cloth_zones(views, cloth, limbs)) {}

  TopBottom run() {
    TopBottom result;
    result.has_top = area(kSureTop) >= params_.least_mm2;
    if (result.has_top)
      result.has_bottom = find_hem_boundary();
    else
      result.has_bottom = area(kSureBottom) >= params_.least_mm2;
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
  // Two garments where a curve is found on whose sides the colours differ, or where the cloth goes round each leg. The
  // bottom's first colours are those low on the legs, at the lower end of the cloth, or those there that are foreign to
  // the top: the curve that tells the colours best stands.
  bool find_hem_boundary() {
    const auto low = zones_;
    const bool forked = area(kSureBottom) >= params_.least_mm2 && goes_round_each_leg();
    double most_nats = -1;
    std::vector<int> hem;
    std::vector<cv::Mat> nats;
    for (int start = 0; start < 3; ++start) {
      if (start == 1) zones_ = with_lower_end(low, views_, cloth_, limbs_, grid_);
      if (start == 2) zones_ = without_colors_of_top(zones_, views_, cloth_, limbs_);
      if (area(kSureBottom) < kLeastSeed_mm2) continue;
      trace();
      const HemEvidence evidence = judged();
      if (!differ(evidence) || evidence.color_nats <= most_nats) continue;
      most_nats = evidence.color_nats;
      hem = hem_;
      nats = nats_;
      if (most_nats > kPlainNats) break;
    }
    zones_ = low;
    hem_ = hem;
    nats_ = nats;
    nats_.resize(views_.size());
    if (hem.empty() && forked) trace_edges();
    return !hem_.empty();
  }

  bool differ(const HemEvidence& evidence) const {
    return evidence.color_nats >= params_.least_nats && evidence.below_mm2 >= params_.least_mm2 &&
           std::min(evidence.told_above, evidence.told_below) >= params_.least_share;
  }

  double area(Zone zone) const { return zone_area_mm2(zones_, views_, zone); }

  bool goes_round_each_leg() const {
    std::vector<Vector3d> low;
    for (std::size_t k = 0; k < views_.size(); ++k) {
      each_cloth_pixel(views_[k], cloth_[k], [&](int v, int u) {
        const auto& p = views_[k].place_m.at<cv::Vec3f>(v, u);
        if (views_[k].measured.at<uchar>(v, u) && zones_[k].at<uchar>(v, u) == kSureBottom)
          low.emplace_back(p[0], p[1], p[2]);
      });
    }
    const LegVotes votes = leg_votes(low, limbs_);
    return votes.parts >= 2 && votes.parts > votes.spans;
  }

  HemEvidence judged() const {
    std::vector<CurveOnView> curve(views_.size());
    for (std::size_t k = 0; k < views_.size(); ++k) {
      if (views_[k].box.empty()) continue;
      curve[k].above_m = cv::Mat(views_[k].box.size(), CV_32F, cv::Scalar(std::nanf("")));
      curve[k].column = cv::Mat::zeros(views_[k].box.size(), CV_8U);
      each_cloth_pixel(views_[k], cloth_[k], [&](int v, int u) {
        if (zones_[k].at<uchar>(v, u) == kSleeve) return;
        const auto& place = views_[k].place_m.at<cv::Vec3f>(v, u);
        curve[k].above_m.at<float>(v, u) = grid_.above(place, hem_);
        curve[k].column.at<uchar>(v, u) = static_cast<uchar>(grid_.column(place));
      });
    }
    return hem_evidence(views_, curve);
  }

  std::vector<int> hem_of(const cv::Mat& nats) const {
    const std::vector<int> first = trace_hem(nats, params_.row_price);
    return trace_hem(near_plane(nats, first, kOffPlane_rows, kBinNats), params_.row_price);
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
      hem_ = hem_of(gathered_nats());
      for (std::size_t k = 0; k < views_.size(); ++k)
        if (!zones_[k].empty()) split_by_curve(k, 0.02, top[k], bottom[k]);
    }
    weigh_colors(top, bottom);
  }

  // For garments of the same colours: where one hangs over the other.
  void trace_edges() {
    std::vector<cv::Mat> told(views_.size());
    for (std::size_t k = 0; k < views_.size(); ++k)
      if (!zones_[k].empty()) told[k] = (zones_[k] != kNowhere) & (zones_[k] != kSleeve);
    const double hand = 0.05 * (limbs_.top_y - limbs_.floor_y);
    hem_ = hem_of(edge_nats(views_, told, grid_, limbs_.crotch_y - 2 * hand, limbs_.armpit_y - hand));
    for (std::size_t k = 0; k < views_.size(); ++k)
      if (!views_[k].box.empty()) nats_[k] = cv::Mat::zeros(views_[k].box.size(), CV_32F);
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
    cv::Mat sum = cv::Mat::zeros(grid_.rows, TrunkGrid::kColumns, CV_32F), count = sum.clone(), seed = sum.clone();
    for (std::size_t k = 0; k < views_.size(); ++k) {
      each_cloth_pixel(views_[k], cloth_[k], [&](int v, int u) {
        const uchar zone = zones_[k].at<uchar>(v, u);
        if (zone == kSleeve) return;
        const auto& place = views_[k].place_m.at<cv::Vec3f>(v, u);
        const int r = grid_.row(place), c = grid_.column(place);
        sum.at<float>(r, c) += nats_[k].at<float>(v, u);
        count.at<float>(r, c) += 1;
        if (zone != kBetween) seed.at<float>(r, c) = zone == kSureTop ? kSeedNats : -kSeedNats;
      });
    }
    cv::Mat nats = seed;
    for (int r = 0; r < grid_.rows; ++r) {
      for (int c = 0; c < TrunkGrid::kColumns; ++c) {
        const float pixels = count.at<float>(r, c);
        if (pixels == 0) continue;
        const float full = std::min(1.f, pixels / kFullCell);
        nats.at<float>(r, c) += std::clamp(sum.at<float>(r, c) / pixels * 2 * full, -kBinNats, kBinNats);
      }
    }
    return nats;
  }

  void split_by_curve(std::size_t k, float margin_m, cv::Mat& top, cv::Mat& bottom) const {
    top = cv::Mat::zeros(views_[k].box.size(), CV_8U);
    bottom = top.clone();
    each_cloth_pixel(views_[k], cloth_[k], [&](int v, int u) {
      const float height = grid_.above(views_[k].place_m.at<cv::Vec3f>(v, u), hem_);
      const bool sleeve = zones_[k].at<uchar>(v, u) == kSleeve;
      if (sleeve || height > margin_m) top.at<uchar>(v, u) = 255;
      if (!sleeve && height < -margin_m) bottom.at<uchar>(v, u) = 255;
    });
    top = eroded(top, 1);
    bottom = eroded(bottom, 1);
  }

  // The curve's division of one view, moved to the edges of the image.
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
        const float height = grid_.above(place, hem_);
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
  const TrunkGrid grid_;
  std::vector<cv::Mat> zones_, nats_;
  std::vector<int> hem_;
};

}  // namespace

TopBottom part_cloth(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& cloth, const BodyLimbs& limbs,
                     const TopBottomParams& params) {
  return HemBoundarySearch(views, cloth, limbs, params).run();
}

}  // namespace dressform
