#include "pipeline/segment/skin_colored_cloth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "pipeline/segment/view_models.h"

namespace dressform {
namespace {

// Of a piece of skin that may be cloth.
constexpr std::size_t kFewestOffsets = 40;
constexpr double kExposedShare = 0.1;    // of head, hands and feet in it
constexpr double kLowQuarter = 0.3;      // of the limit: the lower quartile, so that a piece is not half skin
constexpr double kRegisteredOnly = 2.5;  // of the limit, where only the naked model tells the offset

// Of a part of a piece.
constexpr double kPooled_mm = 25;
constexpr double kPooledShare = 0.25;
constexpr double kBesideCloth = 0.2;
constexpr double kPooledMargin_mm = 1;  // more than of a whole piece
constexpr double kPooledChange = 2;     // noise units: skin that nothing shades does not change so much
constexpr double kPooledShadow = 0.35;  // of it: what clothes shade, they also send light to, and depth lies there

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
      arm[label] += code != 255 && is_arm(static_cast<BodyPart>(code));
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
      bare[label] += exposed_skin(view, y, x) != ExposedSkin::none;
      if (const float offset = view.offset_mm.at<float>(y, x); !std::isnan(offset)) offsets[label].push_back(offset);
    }
  }
  const bool same_place = !view.naked_lab.empty() && !view.moved;
  const double limit_mm = same_place ? raised_mm : kRegisteredOnly * raised_mm;
  std::vector<char> raised(count, 0);
  for (int label = 1; label < count; ++label) {
    auto& own = offsets[label];
    if (own.size() < kFewestOffsets || bare[label] > kExposedShare * size[label]) continue;
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

// Without the pieces of `parts` of whose edge less than kBesideCloth lies at the cloth.
cv::Mat beside_cloth(const cv::Mat& parts, const cv::Mat& cloth) {
  cv::Mat labels, inner, near_cloth, result = parts.clone();
  const int count = cv::connectedComponents(parts, labels, 4);
  cv::erode(parts, inner, cv::Mat());
  cv::dilate(cloth, near_cloth, cv::Mat());
  std::vector<int> edge(count, 0), shared(count, 0);
  for (int y = 0; y < parts.rows; ++y) {
    for (int x = 0; x < parts.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label == 0 || inner.at<uchar>(y, x)) continue;
      ++edge[label];
      shared[label] += near_cloth.at<uchar>(y, x) != 0;
    }
  }
  for (int y = 0; y < parts.rows; ++y)
    for (int x = 0; x < parts.cols; ++x)
      if (const int label = labels.at<int>(y, x); label > 0 && shared[label] < kBesideCloth * edge[label])
        result.at<uchar>(y, x) = 0;
  return result;
}

// The same where such cloth is one piece with bare skin, as beside a cuff: by what 25 mm say together of offset and of
// change against the naked shot. Not on legs, where skirts bend the depth of skin by the light they send there.
void raise_parts(const ViewEvidence& view, double raised_mm, double speck_mm2, cv::Mat& cloth) {
  if (view.naked_lab.empty() || view.moved) return;
  const double px_mm = pixel_size_mm(view);
  const int window = 2 * static_cast<int>(kPooled_mm / px_mm / 2) + 1;
  const cv::Mat skin = view.body & ~cloth;
  const cv::Mat offset = pooled(view.offset_mm, skin & (view.offset_mm == view.offset_mm), window);
  const cv::Mat change = pooled(view.change, skin & (view.change == view.change), window);
  const cv::Mat shadow = pooled(cv::Mat_<float>(view.shadow) / 255, skin, window);
  cv::Mat raised = skin & (offset > raised_mm + kPooledMargin_mm) & (change > kPooledChange) & (shadow < kPooledShadow);
  for (int y = 0; y < raised.rows; ++y) {
    for (int x = 0; x < raised.cols; ++x) {
      const uchar code = view.part.at<uchar>(y, x);
      if (code == 255 || is_leg(static_cast<BodyPart>(code)) || exposed_skin(view, y, x) != ExposedSkin::none)
        raised.at<uchar>(y, x) = 0;
    }
  }
  remove_specks(raised, view.body, speck_mm2, px_mm);
  cloth |= beside_cloth(raised & skin, cloth);
}

}  // namespace

void add_skin_colored_cloth(const ViewEvidence& view, const SkinColoredClothParams& params, cv::Mat& cloth) {
  close_islands(view, params.island_mm2, cloth);
  raise_pieces(view, params.raised_mm, cloth);
  raise_parts(view, params.raised_mm, params.speck_mm2, cloth);
}

}  // namespace dressform
