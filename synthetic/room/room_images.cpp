#include "synthetic/room/room_images.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "scenes/random.h"

namespace dressform {
namespace {

// Smooth noise of about unit amplitude with features of `cell` pixels.
cv::Mat value_noise(cv::Size size, double cell_x, double cell_y, std::uint64_t stream) {
  cv::Mat coarse(static_cast<int>(size.height / cell_y) + 3, static_cast<int>(size.width / cell_x) + 3, CV_32FC1);
  for (int y = 0; y < coarse.rows; ++y)
    for (int x = 0; x < coarse.cols; ++x)
      coarse.at<float>(y, x) = static_cast<float>(2 * uniform(11, stream, y * 100003ull + x) - 1);
  cv::Mat fine;
  cv::resize(coarse, fine, size, 0, 0, cv::INTER_CUBIC);
  return fine;
}

cv::Vec3b shaded(const cv::Vec3f& bgr, float factor) {
  return {cv::saturate_cast<std::uint8_t>(bgr[0] * factor), cv::saturate_cast<std::uint8_t>(bgr[1] * factor),
          cv::saturate_cast<std::uint8_t>(bgr[2] * factor)};
}

}  // namespace

cv::Mat paint_floor(double width_m, double depth_m) {
  const double pixels_per_m = 300;
  const cv::Size size(static_cast<int>(width_m * pixels_per_m), static_cast<int>(depth_m * pixels_per_m));
  const cv::Mat grain = value_noise(size, 60, 2, 1), cloud = value_noise(size, 150, 20, 2);
  const double plank_px = 0.14 * pixels_per_m, length_px = 1.2 * pixels_per_m;
  cv::Mat image(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y) {
    const int row = static_cast<int>(y / plank_px);
    const double shift = length_px * uniform(11, 3, row);
    for (int x = 0; x < size.width; ++x) {
      const int board = static_cast<int>((x + shift) / length_px);
      const float tone = 0.9f + 0.2f * static_cast<float>(uniform(11, 4, row * 64ull + board));
      const bool joint = std::fmod(y, plank_px) < 1.2 || std::fmod(x + shift, length_px) < 1.2;
      const float factor =
          tone * (1 + 0.06f * grain.at<float>(y, x) + 0.05f * cloud.at<float>(y, x)) * (joint ? 0.6f : 1);
      image.at<cv::Vec3b>(y, x) = shaded({92, 122, 150}, factor);
    }
  }
  return image;
}

cv::Mat paint_wall(double width_m, double height_m, int number) {
  const double pixels_per_m = 120;
  const cv::Size size(static_cast<int>(width_m * pixels_per_m), static_cast<int>(height_m * pixels_per_m));
  const cv::Mat fine = value_noise(size, 2, 2, 10 + number), cloud = value_noise(size, 90, 90, 20 + number);
  cv::Mat image(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      image.at<cv::Vec3b>(y, x) =
          shaded({205, 215, 220}, 1 + 0.012f * fine.at<float>(y, x) + 0.02f * cloud.at<float>(y, x));
  return image;
}

cv::Mat paint_poster(double width_m, double height_m, int number) {
  const double pixels_per_m = 400;
  const cv::Size size(static_cast<int>(width_m * pixels_per_m), static_cast<int>(height_m * pixels_per_m));
  cv::Mat image(size, CV_8UC3, cv::Scalar(225, 232, 235));
  const cv::Scalar inks[4] = {{135, 110, 75}, {85, 95, 160}, {105, 130, 100}, {110, 165, 195}};
  for (int i = 0; i < 9; ++i) {
    const auto r = uniform4(11, 40 + number, i);
    const cv::Point centre(static_cast<int>(r[0] * size.width), static_cast<int>((0.15 + 0.7 * r[1]) * size.height));
    const int extent = static_cast<int>((0.06 + 0.16 * r[2]) * size.height);
    const cv::Scalar ink = inks[static_cast<int>(4 * r[3])];
    if (i % 3 == 0) cv::circle(image, centre, extent, ink, cv::FILLED, cv::LINE_AA);
    if (i % 3 == 1)
      cv::rectangle(image, centre - cv::Point(extent, extent / 2), centre + cv::Point(extent, extent / 2), ink,
                    cv::FILLED);
    if (i % 3 == 2)
      cv::line(image, centre - cv::Point(2 * extent, extent), centre + cv::Point(2 * extent, extent), ink, 8,
               cv::LINE_AA);
  }
  cv::rectangle(image, {0, 0}, {size.width - 1, size.height - 1}, cv::Scalar(48, 52, 56),
                2 * static_cast<int>(0.02 * pixels_per_m));
  cv::flip(image, image, 0);  // the grids of the room have v upwards
  return image;
}

}  // namespace dressform
