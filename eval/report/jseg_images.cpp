#include "eval/report/jseg_images.h"

#include <limits>
#include <opencv2/imgproc.hpp>

#include "eval/report/image_tools.h"
#include "scenes/error.h"

namespace dressform {
namespace {

const cv::Scalar kBorder(0, 0, 255), kValley(255, 160, 0);
constexpr double kTint = 0.6;

bool parts(const cv::Mat& regions, int y, int x) {
  const int here = regions.at<int>(y, x);
  return (x + 1 < regions.cols && regions.at<int>(y, x + 1) != here) ||
         (y + 1 < regions.rows && regions.at<int>(y + 1, x) != here);
}

// Each class in its mean colour; black outside the mask.
cv::Mat class_image(const ColorClasses& colors) {
  cv::Mat image = cv::Mat::zeros(colors.classes.size(), CV_8UC3);
  if (colors.count() == 0) return image;
  cv::Mat palette(1, colors.count(), CV_32FC3), bgr;
  for (int k = 0; k < colors.count(); ++k) palette.at<cv::Vec3f>(k) = colors.luv[k];
  cv::cvtColor(palette, bgr, cv::COLOR_Luv2BGR);
  bgr.convertTo(bgr, CV_8U, 255);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      if (const int k = colors.classes.at<int>(y, x); k >= 0) image.at<cv::Vec3b>(y, x) = bgr.at<cv::Vec3b>(k);
  return image;
}

cv::Mat j_grey(const cv::Mat& j) {
  cv::Mat grey;
  j.convertTo(grey, CV_8U, 255);
  return grey;
}

}  // namespace

cv::Mat label_image_16bit(const std::string& where, const cv::Mat& labels) {
  double most = 0;
  cv::minMaxLoc(labels, nullptr, &most);
  if (most > std::numeric_limits<std::uint16_t>::max())
    throw InputError(where,
                     "found " + std::to_string(static_cast<long long>(most)) +
                         " labels; expected 65535 at most, which is what a 16-bit PNG holds: a smaller image, or "
                         "a larger --merge");
  cv::Mat image;
  labels.convertTo(image, CV_16U);
  return image;
}

cv::Mat border_overlay(const cv::Mat& bgr, const cv::Mat& regions) {
  cv::Mat image = bgr.clone();
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      if (parts(regions, y, x)) image.at<cv::Vec3b>(y, x) = cv::Vec3b(kBorder[0], kBorder[1], kBorder[2]);
  return image;
}

std::vector<std::pair<std::string, cv::Mat>> jseg_images(const cv::Mat& bgr, const JsegResult& found) {
  std::vector<std::pair<std::string, cv::Mat>> images{{"classes", class_image(found.colors)}};
  for (std::size_t s = 0; s < found.j.size(); ++s)
    images.emplace_back("j_scale" + std::to_string(s + 1), j_grey(found.j[s]));
  images.emplace_back("valleys", tinted(bgr, found.valleys != 0, kValley, kTint));
  images.emplace_back("unmerged", border_overlay(bgr, found.unmerged));
  images.emplace_back("overlay", border_overlay(bgr, found.regions));
  return images;
}

}  // namespace dressform
