#include "eval/metrics/flip.h"

#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "scenes/srgb.h"

namespace dressform::metrics {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Constants of the paper: exponents of colour and feature differences (qc, qf), where the colour difference is bent
// (pc of the largest becomes pt), and the width of an edge that is seen best (w, degrees).
constexpr double kColorExponent = 0.7, kFeatureExponent = 0.5, kBendAt = 0.4, kBendTo = 0.95, kEdgeWidthDeg = 0.082;

// Contrast sensitivity of a channel as a sum of two Gaussians (table 1 of the paper): amplitude a, and b in
// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kAchromatic{1, 0.0047, 0, 1e-5}, kRedGreen{1, 0.0053, 0, 1e-5},
    kBlueYellow{34.1, 0.04, 13.5, 0.025};

// Linear sRGB to XYZ (IEC 61966-2-1) and the white of (1, 1, 1), with which it agrees by construction.
const cv::Matx33d kXyzOfRgb{0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505};
const cv::Vec3d kWhite = kXyzOfRgb * cv::Vec3d(1, 1, 1);

cv::Vec3d opponent_of_xyz(const cv::Vec3d& xyz) {  // Y, red-green, blue-yellow of YCxCz
  const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

cv::Vec3d xyz_of_opponent(const cv::Vec3d& opponent) {
  const double y = (opponent[0] + 16) / 116, x = opponent[1] / 500 + y, z = y - opponent[2] / 200;
  return {x * kWhite[0], y * kWhite[1], z * kWhite[2]};
}

double lab_curve(double t) {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

// L*a*b* with the Hunt effect: chroma counts as much as there is light.
cv::Vec3d hunt_lab_of_xyz(const cv::Vec3d& xyz) {
  const double x = lab_curve(xyz[0] / kWhite[0]), y = lab_curve(xyz[1] / kWhite[1]), z = lab_curve(xyz[2] / kWhite[2]);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

// HyAB (Abasi et al., 2020): city-block between lightness and chroma.
double hyab(const cv::Vec3d& p, const cv::Vec3d& q) {
  return std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]);
}

double largest_color_difference() {
  static const double largest =
      std::pow(hyab(hunt_lab_of_xyz(kXyzOfRgb * cv::Vec3d(0, 1, 0)), hunt_lab_of_xyz(kXyzOfRgb * cv::Vec3d(0, 0, 1))),
               kColorExponent);
  return largest;
}

std::array<cv::Mat, 3> opponent_planes(const cv::Mat& image) {
  std::array<cv::Mat, 3> planes;
  for (auto& plane : planes) plane.create(image.size(), CV_64FC1);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const auto& bgr = image.at<cv::Vec3b>(y, x);
      const cv::Vec3d rgb(linear_of_srgb(bgr[2] / 255.0), linear_of_srgb(bgr[1] / 255.0),
                          linear_of_srgb(bgr[0] / 255.0));
      const cv::Vec3d opponent = opponent_of_xyz(kXyzOfRgb * rgb);
      for (int k = 0; k < 3; ++k) planes[k].at<double>(y, x) = opponent[k];
    }
  return planes;
}

cv::Mat gaussian(double b, int radius, double degrees_per_pixel) {
  cv::Mat kernel(1, 2 * radius + 1, CV_64FC1);
  for (int i = -radius; i <= radius; ++i) {
    const double x = i * degrees_per_pixel;
    kernel.at<double>(0, i + radius) = std::exp(-kPi * kPi * x * x / b);
  }
  return kernel;
}

// A plane as the eye resolves it: the weighted sum of two separable Gaussians, of sum 1.
cv::Mat as_seen(const cv::Mat& plane, const Sensitivity& channel, double pixels_per_degree) {
  const double widest_deg = std::sqrt(kBlueYellow.b1 / (2 * kPi * kPi));  // its sigma: one radius for all channels
  const int radius = static_cast<int>(std::ceil(3 * widest_deg * pixels_per_degree));
  cv::Mat sum = cv::Mat::zeros(plane.size(), CV_64FC1);
  double weight = 0;
  for (const auto& [a, b] : {std::pair(channel.a1, channel.b1), std::pair(channel.a2, channel.b2)}) {
    if (a == 0) continue;
    const cv::Mat kernel = gaussian(b, radius, 1 / pixels_per_degree);
    const double share = a * std::sqrt(kPi / b), total = cv::sum(kernel)[0];
    cv::Mat part;
    cv::sepFilter2D(plane, part, CV_64F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
    sum += share * part;
    weight += share * total * total;
  }
  return sum / weight;
}

// Colours as the eye sees them: filtered, held within what a screen shows, L*a*b* with the Hunt effect.
cv::Mat seen_colors(const std::array<cv::Mat, 3>& planes, double pixels_per_degree) {
  static const cv::Matx33d rgb_of_xyz = kXyzOfRgb.inv();
  const cv::Mat light = as_seen(planes[0], kAchromatic, pixels_per_degree);
  const cv::Mat red_green = as_seen(planes[1], kRedGreen, pixels_per_degree);
  const cv::Mat blue_yellow = as_seen(planes[2], kBlueYellow, pixels_per_degree);
  cv::Mat result(light.size(), CV_64FC3);
  for (int y = 0; y < result.rows; ++y)
    for (int x = 0; x < result.cols; ++x) {
      cv::Vec3d rgb = rgb_of_xyz * xyz_of_opponent({light.at<double>(y, x), red_green.at<double>(y, x),
                                                    blue_yellow.at<double>(y, x)});
      for (int k = 0; k < 3; ++k) rgb[k] = std::min(1.0, std::max(0.0, rgb[k]));
      result.at<cv::Vec3d>(y, x) = hunt_lab_of_xyz(kXyzOfRgb * rgb);
    }
  return result;
}

// The colour difference bent so that what lies beyond kBendAt of the largest is told apart, but counts about alike.
double bent(double difference) {
  const double largest = largest_color_difference(), bend = kBendAt * largest;
  if (difference < bend) return difference * kBendTo / bend;
  return kBendTo + (difference - bend) / (largest - bend) * (1 - kBendTo);
}

// A filter whose positive numbers add up to 1 and whose negative ones to -1.
cv::Mat balanced(cv::Mat kernel) {
  double positive = 0, negative = 0;
  for (int i = 0; i < kernel.cols; ++i) (kernel.at<double>(0, i) > 0 ? positive : negative) += kernel.at<double>(0, i);
  for (int i = 0; i < kernel.cols; ++i) kernel.at<double>(0, i) /= kernel.at<double>(0, i) > 0 ? positive : -negative;
  return kernel;
}

struct Features {
  cv::Mat edge, point;  // how strong, at every pixel
};

Features features_of(const cv::Mat& light, double pixels_per_degree) {
  const double sigma = 0.5 * kEdgeWidthDeg * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  cv::Mat smooth(1, 2 * radius + 1, CV_64FC1), slope = smooth.clone(), bump = smooth.clone();
  for (int i = -radius; i <= radius; ++i) {
    const double g = std::exp(-i * i / (2 * sigma * sigma));
    smooth.at<double>(0, i + radius) = g;
    slope.at<double>(0, i + radius) = -i * g;
    bump.at<double>(0, i + radius) = (i * i / (sigma * sigma) - 1) * g;
  }
  smooth /= cv::sum(smooth)[0];
  slope = balanced(slope);
  bump = balanced(bump);
  const auto strength = [&](const cv::Mat& kernel) {
    cv::Mat along_x, along_y, norm;
    cv::sepFilter2D(light, along_x, CV_64F, kernel, smooth, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::sepFilter2D(light, along_y, CV_64F, smooth, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::magnitude(along_x, along_y, norm);
    return norm;
  };
  return {strength(slope), strength(bump)};
}

}  // namespace

cv::Mat flip_map(const cv::Mat& a, const cv::Mat& b, double pixels_per_degree) {
  if (a.type() != CV_8UC3 || b.type() != CV_8UC3 || a.size() != b.size())
    throw std::invalid_argument("flip: expected two 8-bit BGR images of one size");
  const auto planes_a = opponent_planes(a), planes_b = opponent_planes(b);
  const cv::Mat colors_a = seen_colors(planes_a, pixels_per_degree),
                colors_b = seen_colors(planes_b, pixels_per_degree);
  const auto unit_light = [](const cv::Mat& light) { return cv::Mat((light + 16) / 116); };
  const Features in_a = features_of(unit_light(planes_a[0]), pixels_per_degree);
  const Features in_b = features_of(unit_light(planes_b[0]), pixels_per_degree);
  cv::Mat result(a.size(), CV_32FC1);
  for (int y = 0; y < a.rows; ++y)
    for (int x = 0; x < a.cols; ++x) {
      const double color =
          bent(std::pow(hyab(colors_a.at<cv::Vec3d>(y, x), colors_b.at<cv::Vec3d>(y, x)), kColorExponent));
      const double feature = std::max(std::abs(in_a.edge.at<double>(y, x) - in_b.edge.at<double>(y, x)),
                                      std::abs(in_a.point.at<double>(y, x) - in_b.point.at<double>(y, x)));
      const double structure = std::pow(std::min(1.0, feature / std::sqrt(2.0)), kFeatureExponent);
      result.at<float>(y, x) = static_cast<float>(std::min(1.0, std::pow(color, 1 - structure)));
    }
  return result;
}

double flip_mean(const cv::Mat& a, const cv::Mat& b, double pixels_per_degree) {
  return cv::mean(flip_map(a, b, pixels_per_degree))[0];
}

}  // namespace dressform::metrics
