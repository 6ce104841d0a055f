#include <algorithm>
#include <cmath>
#include <opencv2/photo.hpp>
#include <vector>

#include "pipeline/fill/fill_views.h"
#include "pipeline/fill/garment_inpaint.h"

namespace dressform {
namespace {

struct ReprojectParams {
  GarmentDepthParams depth;
  HoleParams holes;
  double agree_mm = 20;
  double inpaint_px = 4;
};
template <class V>
void fields(V& v, ReprojectParams& p) {
  shared_fields(v, p.depth, p.holes);
  v("agree_mm", p.agree_mm, 1, 200, "mm", "another view sees the same surface when depths differ by less");
  v("inpaint_px", p.inpaint_px, 1, 30, "px", "radius of inpainting where no view sees the surface");
}

constexpr int kMargin_px = 12;  // round the hole, from which colours flow in

struct Candidate {
  cv::Vec3b color{0, 0, 0};
  double facing = 0;  // 0: no view sees it
};

// The colour another view gives a point of this garment; facing 0 when that view does not see it.
Candidate seen_by(const GarmentView& other, const Vector3d& in_model, const Vector3d& normal, double agree_mm) {
  if (other.labels.empty()) return {};
  const Vector3d in_sensor = other.model_from_sensor.inverse() * in_model;
  const Vector3d in_color = other.calibration.color_from_ir * in_sensor;
  if (in_color.z() < 0.1) return {};
  const Vector2d pixel = other.calibration.color->project(in_color);
  if (!other.calibration.color->contains(pixel)) return {};
  const cv::Point at(std::clamp(cvRound(pixel.x()), 0, other.labels.cols - 1),
                     std::clamp(cvRound(pixel.y()), 0, other.labels.rows - 1));
  if (other.garment.mask.at<uchar>(at) != 255) return {};
  const float z = other.map.z_mm.at<float>(at);
  if (!(z > 0) || std::abs(z - 1000 * in_color.z()) > agree_mm) return {};
  const Vector3d towards = (other.model_from_sensor.translation() - in_model).normalized();
  return {other.garment.color.at<cv::Vec3b>(at), std::max(0.0, towards.dot(normal))};
}

// Where the view's filled depth says the pixel's surface is, model frame.
Vector3d place_of(const GarmentView& view, const cv::Point& pixel) {
  const auto& at = view.map.depth_pixel.at<cv::Vec2f>(pixel);
  const Vector3d in_sensor =
      view.calibration.ir.unproject(Vector2d(at[0], at[1]), view.map.depth_mm.at<float>(pixel) / 1000);
  return view.model_from_sensor * in_sensor;
}

// Gain per channel that makes `other`'s colours this view's, from the garment's mean colours.
cv::Vec3d gain(const GarmentView& view, const GarmentView& other) {
  const cv::Scalar a = cv::mean(view.garment.color, view.garment.mask == 255);
  const cv::Scalar b = cv::mean(other.garment.color, other.garment.mask == 255);
  cv::Vec3d result(1, 1, 1);
  for (int k = 0; k < 3; ++k)
    if (b[k] > 1) result[k] = std::clamp(a[k] / b[k], 0.6, 1.6);
  return result;
}

// From the other views where they see the place well enough, else inpainted from the garment alone (Telea, 2004).
cv::Mat paint(const std::vector<GarmentView>& views, std::size_t index, const ReprojectParams& params) {
  const GarmentView& view = views[index];
  cv::Mat color = view.garment.color.clone();
  cv::Mat hole = view.garment.mask == 128, inside = well_inside(view.garment);
  std::vector<cv::Vec3d> gains;
  for (const GarmentView& other : views) gains.push_back(other.labels.empty() ? cv::Vec3d(1, 1, 1) : gain(view, other));
  for (int y = 0; y < color.rows; ++y) {
    for (int x = 0; x < color.cols; ++x) {
      if (view.garment.mask.at<uchar>(y, x) != 128) continue;
      const Vector3d place = place_of(view, {x, y});
      const Vector3d outward = (view.model_from_sensor.translation() - place).normalized();
      for (std::size_t k = 0; k < views.size(); ++k) {
        if (k == index) continue;
        const Candidate found = seen_by(views[k], place, outward, params.agree_mm);
        if (found.facing < 0.2) continue;
        for (int c = 0; c < 3; ++c)
          color.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(gains[k][c] * found.color[c]);
        hole.at<uchar>(y, x) = 0;
        inside.at<uchar>(y, x) = 255;
        break;
      }
    }
  }
  return inpainted_from(color, hole, inside, kMargin_px, [&](const cv::Mat& bgr, const cv::Mat& unknown) {
    cv::Mat inpainted;
    cv::inpaint(bgr, unknown, inpainted, params.inpaint_px, cv::INPAINT_TELEA);
    return inpainted;
  });
}

FilledViews reproject(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                      const Registration& registration, const Segmentation& segmentation,
                      const ReprojectParams& params) {
  return fill_views(session, calibration, naked, registration, segmentation, params.depth, params.holes,
                    [&](const std::vector<GarmentView>& views, std::size_t k) { return paint(views, k, params); });
}

const Fill::Variant reproject_variant{"reproject", reproject};

}  // namespace
}  // namespace dressform
