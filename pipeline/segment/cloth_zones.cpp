#include "pipeline/segment/cloth_zones.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "pipeline/segment/view_models.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr float kSleeveEnd = 0.7f;  // of the arm: cloth above is sleeve, below it may hang from the hips
constexpr double kLowPart = 0.6;    // of what hangs below the crotch: surely bottom
constexpr double kHand = 0.05, kBelowArmpit = 0.04;  // of the stature
constexpr float kEndStrip_m = 0.03;                  // of the lower end
constexpr std::size_t kLeastSeen = 10;               // pixels of a direction, to tell where its cloth ends
constexpr float kForeignNats = -1;                   // against uniform: colours that the top does not have
constexpr int kStrays = 50;                          // one pixel of so many may lie beyond an end

// The height below which one of kStrays lies, of one value at least.
float low_end(std::vector<float> heights) {
  const std::size_t strays = heights.size() / kStrays;
  return nth_value(std::move(heights), strays);
}

// Cloth low on the legs, whatever its length: the lower 60 % of what hangs more than a hand below the crotch.
double sure_bottom_height(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& cloth,
                          const Landmarks& limbs) {
  std::vector<float> heights;
  for (std::size_t k = 0; k < views.size(); ++k) {
    each_cloth_pixel(views[k], cloth[k], [&](int v, int u) {
      const float y = views[k].place_m.at<cv::Vec3f>(v, u)[1];
      if (y < limbs.crotch_y) heights.push_back(y);
    });
  }
  const double lowest = heights.empty() ? limbs.crotch_y : low_end(std::move(heights));
  const double hand = kHand * (limbs.top_y - limbs.floor_y);
  return std::min(limbs.crotch_y - hand, lowest + kLowPart * (limbs.crotch_y - lowest));
}

}  // namespace

std::vector<cv::Mat> cloth_zones(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& cloth,
                                 const Landmarks& limbs) {
  const double chest = limbs.armpit_y - kBelowArmpit * (limbs.top_y - limbs.floor_y);
  const double low = sure_bottom_height(views, cloth, limbs);
  std::vector<cv::Mat> zones(views.size());
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (views[k].box.empty()) continue;
    zones[k] = cv::Mat::zeros(views[k].box.size(), CV_8U);
    each_cloth_pixel(views[k], cloth[k], [&](int v, int u) {
      const auto part = static_cast<BodyPart>(views[k].part.at<uchar>(v, u));
      const float y = views[k].place_m.at<cv::Vec3f>(v, u)[1];
      const bool arm = is_arm(part);
      Zone zone = kBetween;
      if (arm && views[k].limb_end.at<float>(v, u) < kSleeveEnd && y > limbs.crotch_y)
        zone = kSleeve;
      else if (y > chest)
        zone = kSureTop;
      else if (y < low && !arm)
        zone = kSureBottom;
      zones[k].at<uchar>(v, u) = zone;
    });
  }
  return zones;
}

std::vector<cv::Mat> with_lower_end(std::vector<cv::Mat> zones, const std::vector<ViewEvidence>& views,
                                    const std::vector<cv::Mat>& cloth, const Landmarks& limbs, const TrunkGrid& grid) {
  for (cv::Mat& zone : zones) zone = zone.clone();
  std::vector<std::vector<float>> heights(TrunkGrid::kColumns);
  const auto each = [&](const auto& visit) {
    for (std::size_t k = 0; k < views.size(); ++k) {
      each_cloth_pixel(views[k], cloth[k], [&](int v, int u) {
        uchar& zone = zones[k].at<uchar>(v, u);
        const auto& place = views[k].place_m.at<cv::Vec3f>(v, u);
        if (zone != kSleeve && zone != kSureTop && place[1] < limbs.waist_y)
          visit(zone, place[1], heights[grid.column(place)]);
      });
    }
  };
  each([](uchar&, float y, std::vector<float>& own) { own.push_back(y); });
  for (auto& own : heights)
    if (own.size() >= kLeastSeen)
      own = {low_end(std::move(own))};
    else
      own.clear();
  each([](uchar& zone, float y, const std::vector<float>& lowest) {
    zone = !lowest.empty() && y < lowest[0] + kEndStrip_m ? kSureBottom : kBetween;
  });
  return zones;
}

std::vector<cv::Mat> without_colors_of_top(std::vector<cv::Mat> zones, const std::vector<ViewEvidence>& views,
                                           const std::vector<cv::Mat>& cloth, const Landmarks& limbs) {
  for (cv::Mat& zone : zones) zone = zone.clone();
  std::vector<cv::Mat> top(views.size());
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (views[k].box.empty()) continue;
    top[k] = cv::Mat::zeros(views[k].box.size(), CV_8U);
    each_cloth_pixel(views[k], cloth[k], [&](int v, int u) {
      if (views[k].place_m.at<cv::Vec3f>(v, u)[1] > limbs.waist_y) top[k].at<uchar>(v, u) = 255;
    });
  }
  const auto colors = shared_models(top, lab_images(views), true);
  for (std::size_t k = 0; k < views.size(); ++k) {
    each_cloth_pixel(views[k], cloth[k], [&](int v, int u) {
      uchar& zone = zones[k].at<uchar>(v, u);
      if (zone == kSureBottom && colors[k].log_density(views[k].lab.at<cv::Vec3b>(v, u)) > kForeignNats)
        zone = kBetween;
    });
  }
  return zones;
}

double zone_area_mm2(const std::vector<cv::Mat>& zones, const std::vector<ViewEvidence>& views, Zone zone) {
  double area = 0;
  for (std::size_t k = 0; k < views.size(); ++k)
    if (!zones[k].empty()) area += cv::countNonZero(zones[k] == zone) * std::pow(pixel_size_mm(views[k]), 2);
  return area;
}

}  // namespace dressform
