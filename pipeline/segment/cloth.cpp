#include "pipeline/segment/cloth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "pipeline/common/color_histogram.h"
#include "pipeline/common/graph_cut.h"
#include "pipeline/segment/color_change.h"
#include "pipeline/segment/view_models.h"

namespace dressform {
namespace {

constexpr float kCloth_mm = 60;  // offsets of cloth are taken as uniform up to here
constexpr float kSureCloth_mm = 10, kSureSkin_mm = 4;
constexpr float kUnchanged = 3;      // noise units
constexpr float kUncoveredNats = 3;  // where the naked shot shows the room, the dressed one shows cloth
constexpr float kShadowPrice = 1;    // nats: shadows on skin are seldom
constexpr float kHeadNats = 3, kHandNats = 2, kFootNats = 1.5;

// Of a piece of skin that may be cloth.
constexpr std::size_t kFewestOffsets = 40;
constexpr double kBareShare = 0.1;       // of head, hands and feet in it
constexpr double kLowQuarter = 0.3;      // of the limit: the lower quartile, so that a piece is not half skin
constexpr double kRegisteredOnly = 2.5;  // of the limit, where only the naked model tells the offset

// Of a part of a piece.
constexpr double kPooled_mm = 25;
constexpr double kPooledShare = 0.25;
constexpr double kPooledMargin_mm = 1;  // more than of a whole piece
constexpr double kUnchangedMargin_mm = 3;
constexpr double kPooledChange = 2;  // noise units: skin that nothing shades does not change so much

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

// Places that clothes leave bare.
float part_nats(const ViewEvidence& view, int v, int u) {
  const uchar code = view.part.at<uchar>(v, u);
  if (code == 255) return 0;
  const auto part = static_cast<BodyPart>(code);
  const float end = view.limb_end.at<float>(v, u);
  if (part == BodyPart::head) return -kHeadNats;
  if (is_arm(part) && end > 0.85f) return -kHandNats;
  if ((part == BodyPart::left_leg || part == BodyPart::right_leg) && end > 0.93f) return -kFootNats;
  return 0;
}

// All that does not depend on colour models. Positive: cloth.
cv::Mat fixed_nats(const ViewEvidence& view, const ClothParams& params) {
  cv::Mat nats = cv::Mat::zeros(view.box.size(), CV_32F);
  for (int v = 0; v < nats.rows; ++v) {
    for (int u = 0; u < nats.cols; ++u) {
      if (!view.body.at<uchar>(v, u)) continue;
      nats.at<float>(v, u) = shape_nats(view.offset_mm.at<float>(v, u), params) +
                             change_nats(view.change.at<float>(v, u), params) + part_nats(view, v, u) +
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
      const bool unchanged = change < kShadowUnits, head = part_nats(view, v, u) < 0;
      if (offset > kSureCloth_mm && !unchanged && !head) cloth.at<uchar>(v, u) = 255;
      if (offset < kSureSkin_mm && (unchanged || head)) skin.at<uchar>(v, u) = 255;
    }
  }
}

// Skin that cloth encloses, on trunk or legs: a print of the skin's colour. Arms before the trunk stay.
void close_islands(const ViewEvidence& view, double island_mm2, cv::Mat& cloth) {
  const cv::Mat skin = view.body & ~cloth;
  cv::Mat labels, near_room;
  const int count = cv::connectedComponents(skin, labels, 4);
  std::vector<int> size(count, 0), arm(count, 0), open(count, 0);
  cv::dilate(view.body == 0, near_room, cv::Mat());
  for (int y = 0; y < skin.rows; ++y) {
    for (int x = 0; x < skin.cols; ++x) {
      const int label = labels.at<int>(y, x);
      const uchar code = view.part.at<uchar>(y, x);
      ++size[label];
      arm[label] += code == static_cast<uchar>(BodyPart::left_arm) || code == static_cast<uchar>(BodyPart::right_arm);
      open[label] += near_room.at<uchar>(y, x) != 0;
    }
  }
  const double px_mm = pixel_size_mm(view);
  for (int y = 0; y < skin.rows; ++y) {
    for (int x = 0; x < skin.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label > 0 && open[label] == 0 && 2 * arm[label] < size[label] && size[label] * px_mm * px_mm < island_mm2)
        cloth.at<uchar>(y, x) = 255;
    }
  }
}

// Pieces of skin that stand off the body as a whole: cloth of the skin's colour. One pixel's offset says little beside
// its colour; the median of a piece is good to a fraction of a millimetre where the naked shot shows the same place,
// and to what the registration leaves elsewhere.
void raise_pieces(const ViewEvidence& view, double raised_mm, cv::Mat& cloth) {
  const cv::Mat skin = view.body & ~cloth;
  cv::Mat labels;
  const int count = cv::connectedComponents(skin, labels, 4);
  std::vector<std::vector<float>> offsets(count);
  std::vector<int> size(count, 0), bare(count, 0);
  for (int y = 0; y < skin.rows; ++y) {
    for (int x = 0; x < skin.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label == 0) continue;
      ++size[label];
      bare[label] += part_nats(view, y, x) < 0;
      if (const float offset = view.offset_mm.at<float>(y, x); !std::isnan(offset)) offsets[label].push_back(offset);
    }
  }
  const bool same_place = !view.naked_lab.empty() && !view.moved;
  const double limit_mm = same_place ? raised_mm : kRegisteredOnly * raised_mm;
  std::vector<char> raised(count, 0);
  for (int label = 1; label < count; ++label) {
    auto& own = offsets[label];
    if (own.size() < kFewestOffsets || bare[label] > kBareShare * size[label]) continue;
    std::sort(own.begin(), own.end());
    raised[label] = own[own.size() / 2] > limit_mm && own[own.size() / 4] > kLowQuarter * limit_mm;
  }
  for (int y = 0; y < skin.rows; ++y)
    for (int x = 0; x < skin.cols; ++x)
      if (raised[labels.at<int>(y, x)]) cloth.at<uchar>(y, x) = 255;
}

// Mean of the values where `use` is set, over a square window; NaN where less than kPooledShare of it counts.
cv::Mat pooled(const cv::Mat& values, const cv::Mat& use, int window_px) {
  cv::Mat counted = cv::Mat::zeros(values.size(), CV_32F), ones = counted.clone(), sum, share;
  values.copyTo(counted, use);
  ones.setTo(1, use);
  const cv::Size window(window_px, window_px);
  cv::boxFilter(counted, sum, CV_32F, window, {-1, -1}, true, cv::BORDER_CONSTANT);
  cv::boxFilter(ones, share, CV_32F, window, {-1, -1}, true, cv::BORDER_CONSTANT);
  cv::Mat mean = sum / share;
  mean.setTo(std::numeric_limits<float>::quiet_NaN(), share < kPooledShare);
  return mean;
}

// The same where such cloth is one piece with bare skin, as beside a cuff: by what a hand's breadth says together of
// offset and of change against the naked shot.
void raise_parts(const ViewEvidence& view, double raised_mm, double speck_mm2, cv::Mat& cloth) {
  if (view.naked_lab.empty() || view.moved) return;
  const double px_mm = pixel_size_mm(view);
  const int window = 2 * static_cast<int>(kPooled_mm / px_mm / 2) + 1;
  const cv::Mat skin = view.body & ~cloth;
  const cv::Mat offset = pooled(view.offset_mm, skin & (view.offset_mm == view.offset_mm), window);
  const cv::Mat change = pooled(view.change, skin & (view.change == view.change), window);
  cv::Mat raised = skin & (((offset > raised_mm + kPooledMargin_mm) & (change > kPooledChange)) |
                           (offset > raised_mm + kUnchangedMargin_mm));
  for (int y = 0; y < raised.rows; ++y)
    for (int x = 0; x < raised.cols; ++x)
      if (raised.at<uchar>(y, x) && part_nats(view, y, x) < 0) raised.at<uchar>(y, x) = 0;
  remove_specks(raised, view.body, speck_mm2, px_mm);
  cloth |= raised & skin;
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
  close_islands(view, params.island_mm2, cut);
  raise_pieces(view, params.raised_mm, cut);
  raise_parts(view, params.raised_mm, params.speck_mm2, cut);
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
