#include "synthetic/capture/film.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "scenes/random.h"
#include "synthetic/capture/texture_pyramid.h"

namespace dressform {
namespace {

constexpr float kHeadroom = 1.25f;  // wells are full this far above white, so that white balance leaves no tint there
constexpr float kBlack = 1024;      // of 16 bits: noise about zero is not cut off
constexpr float kWhite = (65535 - kBlack) / kHeadroom;

std::uint16_t raw_level(float light, const FilmSpec& film, float noise) {
  const float electrons = std::max(0.0f, light) * film.gain * film.electrons_full_scale;
  const float sigma = std::sqrt(electrons + film.read_noise_electrons * film.read_noise_electrons);
  return cv::saturate_cast<std::uint16_t>(kBlack + kWhite * (electrons + sigma * noise) / film.electrons_full_scale);
}

// Raw levels of all three colours in BGR order, or of one colour a pixel.
cv::Mat exposed(const cv::Mat& light, const FilmSpec& film, Seed seed) {
  cv::Mat raw(light.size(), film.mosaic ? CV_16UC1 : CV_16UC3);
  tbb::parallel_for(0, light.rows, [&](int y) {
    for (int x = 0; x < light.cols; ++x) {
      const auto& rgb = light.at<cv::Vec3f>(y, x);
      const auto noise = normal4(seed, stream_of("color"), static_cast<std::uint64_t>(y) * light.cols + x);
      if (film.mosaic) {
        const int c = y % 2 + x % 2;
        raw.at<std::uint16_t>(y, x) = raw_level(rgb[c], film, static_cast<float>(noise[0]));
      } else {
        for (int c = 0; c < 3; ++c)
          raw.at<cv::Vec3w>(y, x)[2 - c] = raw_level(rgb[c], film, static_cast<float>(noise[c]));
      }
    }
  });
  return raw;
}

// 8-bit sRGB levels of a channel's raw levels.
std::vector<std::uint8_t> tone_curve(float white_balance) {
  std::vector<std::uint8_t> curve(65536);
  for (std::size_t i = 0; i < curve.size(); ++i)
    curve[i] = cv::saturate_cast<std::uint8_t>(
        255.0f * srgb_from_linear(white_balance * (static_cast<float>(i) - kBlack) / kWhite));
  return curve;
}

cv::Mat toned(const cv::Mat& raw, const FilmSpec& film) {
  const std::vector<std::uint8_t> curves[] = {tone_curve(film.white_balance[2]), tone_curve(film.white_balance[1]),
                                              tone_curve(film.white_balance[0])};
  cv::Mat image(raw.size(), CV_8UC3);
  tbb::parallel_for(0, raw.rows, [&](int y) {
    for (int x = 0; x < raw.cols; ++x)
      for (int c = 0; c < 3; ++c) image.at<cv::Vec3b>(y, x)[c] = curves[c][raw.at<cv::Vec3w>(y, x)[c]];
  });
  return image;
}

}  // namespace

cv::Mat developed(const cv::Mat& light, const FilmSpec& film, Seed seed) {
  cv::Mat raw = exposed(light, film, seed);
  if (film.mosaic) {
    cv::Mat all;
    cv::demosaicing(raw, all, cv::COLOR_BayerRGGB2BGR_EA);
    raw = all;
  }
  cv::Mat image = toned(raw, film);
  if (film.jpeg_quality == 0) return image;
  std::vector<std::uint8_t> stream;
  cv::imencode(".jpg", image, stream, {cv::IMWRITE_JPEG_QUALITY, film.jpeg_quality});
  return cv::imdecode(stream, cv::IMREAD_COLOR);
}

}  // namespace dressform
