#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/extract/view_task.h"
#include "pipeline/imaging/color_mapping.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

struct ThesisParams {
  double behind_m = 0.4;
  double tracked_deg = 45;
  double naked_floor_margin_m = 0.025;
  ViewFloorParams floor;
};
template <class V>
void fields(V& v, ThesisParams& p) {
  v("behind_m", p.behind_m, 0.05, 3, "m", "what is farther behind the body's axis than this is background");
  v("tracked_deg", p.tracked_deg, 0, 90, "deg",
    "views this near to the front or back, by the rig prior, take the body index where one was recorded; all others, "
    "and those in which nobody was tracked, the depth threshold. Without a prior: all that have a body index take it");
  v("naked_floor_margin_m", p.naked_floor_margin_m, 0, 0.2, "m",
    "what is nearer to the floor than this is left out of the naked shot, which registration aligns with a body alone; "
    "the dressed one keeps its floor, as in the thesis");
  floor_fields(v, p.floor);
}

constexpr int kNobody = 255;          // of the body index
constexpr int kLeastPixels = 100;     // of a body: fewer are none
constexpr double kHalfBody_m = 0.12;  // from the surface that a sensor sees to the body's axis
constexpr double kNearPart = 0.25;    // of the depths in the middle of the image: a wall is most of the rest

// The body index that most pixels have: bystanders are farther away, or cut off by the image.
cv::Mat tracked_body(const cv::Mat& body_index, const cv::Mat& depth_mm) {
  std::array<int, kNobody + 1> counts{};
  for (int y = 0; y < body_index.rows; ++y)
    for (int x = 0; x < body_index.cols; ++x) ++counts[body_index.at<uchar>(y, x)];
  int most = 0;
  for (int k = 1; k < kNobody; ++k)
    if (counts[k] > counts[most]) most = k;
  if (counts[most] < kLeastPixels) return {};
  return (body_index == most) & (depth_mm > 0);
}

// Where the body's axis stands, along the sensor's: by the rig prior, else by what is in the middle of the image.
double depth_of_axis_m(const ViewTask& task, const cv::Mat& depth_mm) {
  if (task.expected.place) return task.expected.place->z();
  std::vector<double> middle;
  for (int y = depth_mm.rows / 4; y < depth_mm.rows * 3 / 4; ++y)
    for (int x = depth_mm.cols * 2 / 5; x < depth_mm.cols * 3 / 5; ++x)
      if (const float mm = depth_mm.at<float>(y, x); mm > 0) middle.push_back(1e-3 * mm);
  return middle.empty() ? 0 : lower_quantile(middle, kNearPart) + kHalfBody_m;
}

bool may_be_tracked(const ViewTask& task, const Shot& shot, const ThesisParams& params) {
  if (shot.body_index.empty()) return false;
  return !task.azimuth_deg || std::abs(std::remainder(*task.azimuth_deg, 180)) <= params.tracked_deg;
}

// The mannequin on the depth grid: uint8, 255.
cv::Mat region_of(const Shot& shot, const cv::Mat& depth_mm, const ViewTask& task, const ThesisParams& params) {
  cv::Mat mask;
  if (may_be_tracked(task, shot, params)) mask = tracked_body(shot.body_index, depth_mm);
  if (mask.empty()) {
    const double limit_mm = 1e3 * (depth_of_axis_m(task, depth_mm) + params.behind_m);
    mask = (depth_mm > 0) & (depth_mm < limit_mm);
  }
  if (cv::countNonZero(mask) < kLeastPixels) mask.setTo(0);
  return mask;
}

// Every depth pixel of the mask as the colour pixels that it covers, from corner to corner, as the SDK maps them.
cv::Mat in_color(const cv::Mat& mask, const cv::Mat& depth_mm, const SensorCalibration& sensor) {
  const Camera& color = *sensor.color;
  cv::Mat result = cv::Mat::zeros(color.height, color.width, CV_8U);
  const cv::Rect image({0, 0}, result.size());
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      if (!mask.at<uchar>(y, x)) continue;
      const double depth_m = 1e-3 * depth_mm.at<float>(y, x);
      const auto corner = [&](double dx, double dy) {
        const Vector3d point = sensor.color_from_ir * sensor.ir.unproject({x + dx, y + dy}, depth_m);
        return point.z() > 0 ? color.project(point) : Vector2d(-1e4, -1e4);
      };
      const Vector2d first = corner(-0.5, -0.5), last = corner(0.5, 0.5);
      const cv::Point from(cvRound(first.x()), cvRound(first.y())), to(cvRound(last.x()) + 1, cvRound(last.y()) + 1);
      result(cv::Rect(from, to) & image) = 255;
    }
  return result;
}

void leave_out_floor(const cv::Mat& points_m, const Eigen::Vector4d& floor, double margin_m, cv::Mat& mask) {
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      const auto& p = points_m.at<cv::Vec3f>(y, x);
      if (mask.at<uchar>(y, x) && floor.dot(Eigen::Vector4d(p[0], p[1], p[2], 1)) < margin_m) mask.at<uchar>(y, x) = 0;
    }
}

void run(ViewTask& task, const ThesisParams& params, Seed seed) {
  const auto cut = [&](const Shot& shot, cv::Mat& mask, cv::Mat& color_mask, bool& found) {
    const cv::Mat depth = corrected_depth_mm(shot.depth_mm, *task.calibration);
    const cv::Mat points = depth_points_m(depth, task.calibration->ir);
    const auto floor = floor_of_view(points, params.floor, task, seed);
    mask = region_of(shot, depth, task, params);
    if (floor && &shot == task.naked) leave_out_floor(points, *floor, params.naked_floor_margin_m, mask);
    found = cv::countNonZero(mask) > 0;
    if (!color_mask.empty() && !shot.color.empty()) color_mask = in_color(mask, depth, *task.calibration);
  };
  if (task.naked) cut(*task.naked, task.masks.naked, task.masks.naked_color, task.masks.found_naked);
  if (task.dressed) cut(*task.dressed, task.masks.dressed, task.masks.dressed_color, task.masks.found_dressed);
}

// Thesis, section 3.2: in front and back the body that the Kinect's own tracking found (Shotton et al., CVPR 2011), at
// left and right whatever is nearer than the background, and so the floor round the feet as well. Each colour pixel is
// what the depth pixel is that it sees. The threshold, set by hand there, lies behind where the rig looks.
ExtractedViews thesis(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                      const ThesisParams& params, Seed seed) {
  auto tasks = view_tasks(session, calibration, naked);
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t k) { run(tasks[k], params, seed); });
  return extracted_views(tasks);
}

const Extract::Variant thesis_variant{"thesis", thesis};

}  // namespace
}  // namespace dressform
