#include "pipeline/fill/garment_inpaint.h"

#include <opencv2/imgproc.hpp>

namespace dressform {
namespace {

constexpr int kMixed_px = 2;  // at the garment's edge, that show what is beside it as well

}  // namespace

cv::Mat inpainted_from(const cv::Mat& bgr, const cv::Mat& hole, const cv::Mat& inside, int margin_px,
                       const Inpaint& inpaint) {
  cv::Mat color = bgr.clone();
  if (cv::countNonZero(hole) == 0) return color;
  const cv::Rect tight = cv::boundingRect(hole);
  const cv::Rect box =
      cv::Rect(tight.x - margin_px, tight.y - margin_px, tight.width + 2 * margin_px, tight.height + 2 * margin_px) &
      cv::Rect({0, 0}, color.size());
  if (cv::countNonZero(inside(box)) == 0) return color;
  const cv::Mat inpainted = inpaint(color(box), inside(box) == 0);
  inpainted.copyTo(color(box), hole(box));
  return color;
}

cv::Mat well_inside(const FilledGarment& garment) {
  cv::Mat inside;
  cv::erode(garment.mask == 255, inside, cv::Mat(), {-1, -1}, kMixed_px);
  return inside;
}

}  // namespace dressform
