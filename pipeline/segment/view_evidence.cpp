#include "pipeline/segment/view_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "pipeline/body/body_chart.h"
#include "pipeline/imaging/color_histogram.h"
#include "pipeline/imaging/color_mapping.h"
#include "pipeline/segment/color_change.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kSameSurface_mm = 20;  // depth differences that are averaged over
constexpr float kComparable_mm = 120;  // further apart, the two shots show different things
constexpr int kMargin_px = 16;
constexpr double kLeastCosine = 0.2;           // seen at a lower one, a change of depth is no change of offset
constexpr float kHand = 0.85f, kFoot = 0.93f;  // of the limb: beyond, clothes leave it bare
constexpr float kFarFill_px = 40;              // of a place taken from a neighbour, at 1920 x 1080

// Mean of the 5 x 5 neighbours on the same surface: about a quarter of the noise, without bias on planes.
cv::Mat smoothed_depth(const cv::Mat& depth_mm) {
  cv::Mat smooth = cv::Mat::zeros(depth_mm.size(), CV_32F);
  for (int y = 0; y < depth_mm.rows; ++y) {
    for (int x = 0; x < depth_mm.cols; ++x) {
      const float center = depth_mm.at<float>(y, x);
      if (!(center > 0)) continue;
      float sum = 0;
      int count = 0;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          // Opposite neighbours together or not at all, so that a slope adds nothing.
          const cv::Point p(x + dx, y + dy), q(x - dx, y - dy);
          const cv::Rect grid({0, 0}, depth_mm.size());
          if (!grid.contains(p) || !grid.contains(q)) continue;
          const float a = depth_mm.at<float>(p), b = depth_mm.at<float>(q);
          if (!(a > 0) || !(b > 0) || std::abs(a - b) > 4 * kSameSurface_mm) continue;
          if (std::abs((a + b) / 2 - center) > kSameSurface_mm) continue;
          sum += a;
          ++count;
        }
      }
      smooth.at<float>(y, x) = sum / static_cast<float>(count);
    }
  }
  return smooth;
}

// What the depth grid knows: images on the IR grid.
struct DepthFacts {
  cv::Mat place_m, part, limb_end, offset_mm, shift_mm;  // shift: towards the sensor since the naked shot; NaN unknown
};

DepthFacts depth_facts(const cv::Mat& dressed_mm, const cv::Mat& naked_mm, const cv::Mat& naked_mask,
                       const cv::Mat& mask, const Camera& ir, const Isometry3d& model_from_sensor,
                       const NakedBody& body) {
  const BodyChart chart(body.limbs);
  const cv::Size size = dressed_mm.size();
  DepthFacts facts{cv::Mat(size, CV_32FC3, cv::Scalar::all(kNaN)), cv::Mat(size, CV_8U, cv::Scalar(255)),
                   cv::Mat::zeros(size, CV_32F), cv::Mat(size, CV_32F, cv::Scalar(kNaN)),
                   cv::Mat(size, CV_32F, cv::Scalar(kNaN))};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float z = dressed_mm.at<float>(y, x);
      if (!mask.at<uchar>(y, x) || !(z > 0)) continue;
      const Vector3d in_sensor = ir.unproject(Vector2d(x, y), z / 1000);
      const Vector3d point = model_from_sensor * in_sensor;
      facts.place_m.at<cv::Vec3f>(y, x) = {static_cast<float>(point.x()), static_cast<float>(point.y()),
                                           static_cast<float>(point.z())};
      const auto closest = body.query.closest(point);
      if (closest.triangle < 0) continue;
      const BodyPart part = body.limbs.triangle_parts[closest.triangle];
      facts.part.at<uchar>(y, x) = static_cast<uchar>(part);
      facts.limb_end.at<float>(y, x) = static_cast<float>(chart.part_of_limb(point, part));
      facts.offset_mm.at<float>(y, x) = static_cast<float>(1000 * body.query.signed_distance(point, closest));
      if (naked_mm.empty() || !naked_mask.at<uchar>(y, x)) continue;
      const float before = naked_mm.at<float>(y, x);
      if (!(before > 0) || std::abs(before - z) > kComparable_mm) continue;
      const Vector3d ray = (model_from_sensor.linear() * in_sensor).normalized();
      const double cosine = std::abs(ray.dot(body.query.normal(closest.triangle)));
      facts.shift_mm.at<float>(y, x) = static_cast<float>((before - z) * std::max(kLeastCosine, cosine));
    }
  }
  return facts;
}

// Of a BodyPart's code, 255 for none, and how far along its limb.
ExposedSkin exposed_skin(uchar code, float limb_end) {
  if (code == 255) return ExposedSkin::none;
  const auto part = static_cast<BodyPart>(code);
  if (part == BodyPart::head) return ExposedSkin::head;
  if (is_arm(part) && limb_end > kHand) return ExposedSkin::hand;
  if (is_leg(part) && limb_end > kFoot) return ExposedSkin::foot;
  return ExposedSkin::none;
}

// Head and hands are bare: where they changed depth, the mannequin moved.
bool mannequin_moved(const DepthFacts& facts, double limit_mm) {
  std::vector<float> shifts;
  for (int y = 0; y < facts.part.rows; ++y) {
    for (int x = 0; x < facts.part.cols; ++x) {
      const ExposedSkin place = exposed_skin(facts.part.at<uchar>(y, x), facts.limb_end.at<float>(y, x));
      if (place != ExposedSkin::head && place != ExposedSkin::hand) continue;
      if (const float shift = facts.shift_mm.at<float>(y, x); !std::isnan(shift)) shifts.push_back(std::abs(shift));
    }
  }
  return shifts.size() >= 30 && median(std::move(shifts)) > limit_mm;
}

// The same camera sees the same place without clothes: free of registration errors, so it is the better offset.
void take_shift_as_offset(DepthFacts& facts) {
  for (int y = 0; y < facts.part.rows; ++y)
    for (int x = 0; x < facts.part.cols; ++x)
      if (const float shift = facts.shift_mm.at<float>(y, x); !std::isnan(shift))
        facts.offset_mm.at<float>(y, x) = shift;
}

// Where bare skin and cloth lie within the window that the depth was smoothed over, the offset is a mean of both: it
// says nothing of where between them the cloth ends, and colour has to.
void forget_offsets_at_ends(DepthFacts& facts) {
  constexpr float kSkin_mm = 4, kCloth_mm = 9;
  cv::Mat low = facts.offset_mm.clone(), high = facts.offset_mm.clone();
  const cv::Mat unknown = facts.offset_mm != facts.offset_mm;
  low.setTo(std::numeric_limits<float>::max(), unknown);
  high.setTo(std::numeric_limits<float>::lowest(), unknown);
  const cv::Mat window = cv::Mat::ones(5, 5, CV_8U);
  cv::erode(low, low, window);
  cv::dilate(high, high, window);
  facts.offset_mm.setTo(kNaN, (low < kSkin_mm) & (high > kCloth_mm));
}

// Unchanged between the shots and away from the body: what holds the mannequin up.
cv::Mat stand_mask(const DepthFacts& facts, const cv::Mat& model_offset_mm, double stand_mm) {
  cv::Mat stand = cv::Mat::zeros(facts.part.size(), CV_8U);
  for (int y = 0; y < stand.rows; ++y) {
    for (int x = 0; x < stand.cols; ++x) {
      const float shift = facts.shift_mm.at<float>(y, x), offset = model_offset_mm.at<float>(y, x);
      if (!std::isnan(shift) && std::abs(shift) < 8 && offset > stand_mm) stand.at<uchar>(y, x) = 255;
    }
  }
  return stand;
}

// Linear between the four depth pixels where all of them know their place, else the nearest one's.
cv::Vec3f place_at(const cv::Mat& place_m, const cv::Vec2f& at) {
  const int x = static_cast<int>(at[0]), y = static_cast<int>(at[1]);
  const float fx = at[0] - static_cast<float>(x), fy = at[1] - static_cast<float>(y);
  if (x + 1 < place_m.cols && y + 1 < place_m.rows) {
    const cv::Vec3f &a = place_m.at<cv::Vec3f>(y, x), &b = place_m.at<cv::Vec3f>(y, x + 1),
                    &c = place_m.at<cv::Vec3f>(y + 1, x), &d = place_m.at<cv::Vec3f>(y + 1, x + 1);
    const cv::Vec3f mean = (a * (1 - fx) + b * fx) * (1 - fy) + (c * (1 - fx) + d * fx) * fy;
    if (!std::isnan(mean[0])) return mean;
  }
  return place_m.at<cv::Vec3f>(cvRound(at[1]), cvRound(at[0]));
}

void bring_to_color(const DepthFacts& facts, const cv::Mat& stand, const ColorDepthMap& map, ViewEvidence& view) {
  for (int v = 0; v < view.box.height; ++v) {
    for (int u = 0; u < view.box.width; ++u) {
      const auto& at = map.depth_pixel.at<cv::Vec2f>(v + view.box.y, u + view.box.x);
      if (std::isnan(at[0])) continue;
      const cv::Point pixel(cvRound(at[0]), cvRound(at[1]));
      if (stand.at<uchar>(pixel)) view.body.at<uchar>(v, u) = 0;
      if (!view.body.at<uchar>(v, u) || facts.part.at<uchar>(pixel) == 255) continue;
      view.measured.at<uchar>(v, u) = 255;
      view.place_m.at<cv::Vec3f>(v, u) = place_at(facts.place_m, at);
      view.part.at<uchar>(v, u) = facts.part.at<uchar>(pixel);
      view.limb_end.at<float>(v, u) = facts.limb_end.at<float>(pixel);
      view.offset_mm.at<float>(v, u) = facts.offset_mm.at<float>(pixel);
    }
  }
}

void fill_from_nearest(ViewEvidence& view, float far_px) {
  cv::Mat distance, labels;
  cv::distanceTransform(view.measured == 0, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<cv::Point> source(1);
  for (int v = 0; v < labels.rows; ++v) {
    for (int u = 0; u < labels.cols; ++u) {
      if (!view.measured.at<uchar>(v, u)) continue;
      const auto label = static_cast<std::size_t>(labels.at<int>(v, u));
      if (source.size() <= label) source.resize(label + 1);
      source[label] = {u, v};
    }
  }
  if (source.size() == 1) return;
  for (int v = 0; v < labels.rows; ++v) {
    for (int u = 0; u < labels.cols; ++u) {
      if (!view.body.at<uchar>(v, u) || view.measured.at<uchar>(v, u) || distance.at<float>(v, u) > far_px) continue;
      const cv::Point from = source[labels.at<int>(v, u)];
      view.place_m.at<cv::Vec3f>(v, u) = view.place_m.at<cv::Vec3f>(from);
      view.part.at<uchar>(v, u) = view.part.at<uchar>(from);
      view.limb_end.at<float>(v, u) = view.limb_end.at<float>(from);
    }
  }
}

ViewEvidence empty_view(const Shot& dressed, const ViewMasks& masks) {
  ViewEvidence view;
  if (dressed.color.empty() || masks.dressed_color.empty() || cv::countNonZero(masks.dressed_color) == 0) return view;
  const cv::Rect tight = cv::boundingRect(masks.dressed_color);
  view.box = cv::Rect(tight.x - kMargin_px, tight.y - kMargin_px, tight.width + 2 * kMargin_px,
                      tight.height + 2 * kMargin_px) &
             cv::Rect({0, 0}, dressed.color.size());
  const cv::Size size = view.box.size();
  view.body = masks.dressed_color(view.box).clone();
  view.lab = smoothed_lab(dressed.color(view.box));
  view.measured = cv::Mat::zeros(size, CV_8U);
  view.place_m = cv::Mat(size, CV_32FC3, cv::Scalar::all(kNaN));
  view.part = cv::Mat(size, CV_8U, cv::Scalar(255));
  view.limb_end = cv::Mat::zeros(size, CV_32F);
  view.offset_mm = cv::Mat(size, CV_32F, cv::Scalar(kNaN));
  view.change = cv::Mat(size, CV_32F, cv::Scalar(kNaN));
  view.shadow = cv::Mat::zeros(size, CV_8U);
  view.uncovered = cv::Mat::zeros(size, CV_8U);
  view.naked_body = cv::Mat::zeros(size, CV_8U);
  return view;
}

void compare_colors(const Shot& dressed, const Shot& naked, const ViewMasks& masks, ViewEvidence& view) {
  const ColorChange change =
      color_change(dressed.color, naked.color, masks.dressed_color | masks.naked_color, view.box);
  view.naked_lab = smoothed_lab(change.matched_naked);
  view.naked_body = masks.naked_color(view.box).clone();
  if (view.moved) return;
  cv::Mat inside, near;
  cv::erode(view.naked_body, inside, cv::Mat(), {-1, -1}, 2);
  cv::dilate(view.naked_body, near, cv::Mat(), {-1, -1}, 3);
  change.units.copyTo(view.change, inside);
  change.shadow.copyTo(view.shadow, inside);
  view.uncovered = near == 0;
}

}  // namespace

ExposedSkin exposed_skin(const ViewEvidence& view, int v, int u) {
  return exposed_skin(view.part.at<uchar>(v, u), view.limb_end.at<float>(v, u));
}

ViewEvidence view_evidence(const Shot& dressed, const Shot* naked, const SensorCalibration& sensor,
                           const ViewMasks& masks, const Isometry3d& model_from_sensor, const NakedBody& body,
                           const EvidenceParams& params) {
  ViewEvidence view = empty_view(dressed, masks);
  if (view.box.empty()) return view;
  const cv::Mat raw_mm = corrected_depth_mm(dressed.depth_mm, sensor);
  const bool compare = naked && masks.found_naked && !naked->color.empty();
  const cv::Mat naked_mm = compare ? smoothed_depth(corrected_depth_mm(naked->depth_mm, sensor)) : cv::Mat();
  DepthFacts facts =
      depth_facts(smoothed_depth(raw_mm), naked_mm, masks.naked, masks.dressed, sensor.ir, model_from_sensor, body);
  cv::Mat stand = cv::Mat::zeros(facts.part.size(), CV_8U);
  view.moved = mannequin_moved(facts, params.moved_mm);
  if (!view.moved) {
    stand = stand_mask(facts, facts.offset_mm, params.stand_mm);
    take_shift_as_offset(facts);
  }
  forget_offsets_at_ends(facts);
  bring_to_color(facts, stand, color_depth_map(raw_mm, sensor), view);
  fill_from_nearest(view, kFarFill_px * static_cast<float>(sensor.color->width) / 1920);
  if (compare) compare_colors(dressed, *naked, masks, view);
  return view;
}

}  // namespace dressform
