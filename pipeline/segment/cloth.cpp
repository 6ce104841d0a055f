#include "pipeline/segment/cloth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/imaging/color_histogram.h"
#include "pipeline/imaging/graph_cut.h"
#include "pipeline/segment/color_change.h"
#include "pipeline/segment/skin_colored_cloth.h"
#include "pipeline/segment/view_models.h"

namespace dressform {
namespace {

constexpr float kCloth_mm = 60;  // offsets of cloth are taken as uniform up to here
constexpr float kSureCloth_mm = 10, kSureSkin_mm = 4;
constexpr float kUnchanged = 3;      // noise units
constexpr float kUncoveredNats = 3;  // where the naked shot shows the room, the dressed one shows cloth
constexpr float kShadowPrice = 1;    // nats: shadows on skin are seldom
constexpr float kHeadNats = 3, kHandNats = 2, kFootNats = 1.5;

// Nats in favour of cloth from the offset: a uniform density against a normal one round zero.
float shape_nats(float offset_mm, const ClothParams& params) {
  if (std::isnan(offset_mm)) return 0;
  const auto sigma = static_cast<float>(params.skin_sigma_mm), most = static_cast<float>(params.shape_nats);
  const float skin = -0.5f * offset_mm * offset_mm / (sigma * sigma) - std::log(sigma * 2.5066f);
  const float nats = -std::log(kCloth_mm) - skin;
  return offset_mm > 0 ? std::clamp(nats, -most, most) : -most;
}

float change_nats(float units, const ClothParams& params) {
  if (std::isnan(units)) return 0;
  const auto most = static_cast<float>(params.change_nats);
  return std::clamp(0.7f * (units - kShadowUnits), -0.7f * most, most);
}

float exposed_nats(ExposedSkin place) {
  switch (place) {
    case ExposedSkin::head:
      return -kHeadNats;
    case ExposedSkin::hand:
      return -kHandNats;
    case ExposedSkin::foot:
      return -kFootNats;
    default:
      return 0;
  }
}

// All that does not depend on colour models. Positive: cloth.
cv::Mat fixed_nats(const ViewEvidence& view, const ClothParams& params) {
  cv::Mat nats = cv::Mat::zeros(view.box.size(), CV_32F);
  for (int v = 0; v < nats.rows; ++v) {
    for (int u = 0; u < nats.cols; ++u) {
      if (!view.body.at<uchar>(v, u)) continue;
      nats.at<float>(v, u) = shape_nats(view.offset_mm.at<float>(v, u), params) +
                             change_nats(view.change.at<float>(v, u), params) + exposed_nats(exposed_skin(view, v, u)) +
                             (view.uncovered.at<uchar>(v, u) ? kUncoveredNats : 0);
    }
  }
  return nats;
}

// Skin from the naked shots where there are any, and from what is surely skin in the dressed ones.
std::vector<ColorHistogram> skin_models(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& skin) {
  std::vector<cv::Mat> masks, images;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const bool naked = !views[k].naked_lab.empty();
    masks.push_back(views[k].box.empty() ? cv::Mat() : naked ? eroded(views[k].naked_body, 2) : skin[k]);
    images.push_back(naked ? views[k].naked_lab : views[k].lab);
  }
  return shared_models(masks, images, true);
}

// First guess: what clearly stands off the body.
void first_guess(const ViewEvidence& view, cv::Mat& skin, cv::Mat& cloth) {
  if (view.box.empty()) return;
  skin = cv::Mat::zeros(view.box.size(), CV_8U);
  cloth = skin.clone();
  for (int v = 0; v < skin.rows; ++v) {
    for (int u = 0; u < skin.cols; ++u) {
      if (!view.body.at<uchar>(v, u)) continue;
      const float offset = view.offset_mm.at<float>(v, u), change = view.change.at<float>(v, u);
      const bool unchanged = change < kShadowUnits, bare = exposed_skin(view, v, u) != ExposedSkin::none;
      if (offset > kSureCloth_mm && !unchanged && !bare) cloth.at<uchar>(v, u) = 255;
      if (offset < kSureSkin_mm && (unchanged || bare)) skin.at<uchar>(v, u) = 255;
    }
  }
}

cv::Mat cut_view(const ViewEvidence& view, const cv::Mat& fixed, const ColorHistogram& skin,
                 const ColorHistogram& cloth, const ClothParams& params) {
  const auto most = static_cast<float>(params.color_nats);
  cv::Mat cost = cv::Mat::zeros(view.box.size(), CV_32F);
  for (int v = 0; v < cost.rows; ++v) {
    for (int u = 0; u < cost.cols; ++u) {
      if (!view.body.at<uchar>(v, u)) continue;
      const auto& color = view.lab.at<cv::Vec3b>(v, u);
      float of_skin = skin.log_density(color);
      if (view.shadow.at<uchar>(v,
                                u))  // skin of its own colour, that clothes shade: seldom seen on the naked mannequin
        of_skin = std::max(of_skin, skin.log_density(view.naked_lab.at<cv::Vec3b>(v, u)) - kShadowPrice);
      const float color_nats = std::clamp(cloth.log_density(color) - of_skin, -most, most);
      cost.at<float>(v, u) = -(fixed.at<float>(v, u) + color_nats);
    }
  }
  // Nodes only where there is body; the room beside it pulls neither way.
  cv::Mat active = view.body, initial = cv::Mat::zeros(view.box.size(), CV_8U);
  initial.setTo(255, cost < 0);
  CutSmoothness smoothness{params.smoothness, 0.05};
  cv::Mat padded = initial & view.body;
  // Beyond the outline the label of the nearest body pixel holds, so that the outline costs nothing.
  cv::dilate(padded, initial, cv::Mat(), {-1, -1}, 2);
  padded.copyTo(initial, view.body);
  cv::Mat cut = binary_cut(view.lab, cost, active, initial, smoothness) & view.body;
  remove_specks(cut, view.body, params.speck_mm2, pixel_size_mm(view));
  add_skin_colored_cloth(view, {params.island_mm2, params.raised_mm, params.speck_mm2}, cut);
  return cut;
}

}  // namespace

std::vector<cv::Mat> find_cloth(const std::vector<ViewEvidence>& views, const ClothParams& params) {
  std::vector<cv::Mat> skin(views.size()), cloth(views.size()), fixed(views.size()), result(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t k) {
    if (views[k].box.empty()) return;
    first_guess(views[k], skin[k], cloth[k]);
    fixed[k] = fixed_nats(views[k], params);
  });
  for (int round = 0; round < params.rounds; ++round) {
    const auto skin_colors = skin_models(views, skin), cloth_colors = shared_models(cloth, lab_images(views));
    tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t k) {
      if (views[k].box.empty()) return;
      result[k] = cut_view(views[k], fixed[k], skin_colors[k], cloth_colors[k], params);
      cloth[k] = eroded(result[k], 2);
      skin[k] = eroded(views[k].body & ~result[k], 2);
    });
  }
  return result;
}

}  // namespace dressform
