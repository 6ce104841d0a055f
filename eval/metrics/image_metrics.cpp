#include "eval/metrics/image_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/metrics/sampling.h"

namespace dressform::metrics {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kPower25To7 = 6103515625.0;

double linear_of(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }
double srgb_of(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

const std::array<double, 256>& linear_table() {
  static const auto table = [] {
    std::array<double, 256> values{};
    for (int i = 0; i < 256; ++i) values[i] = linear_of(i / 255.0);
    return values;
  }();
  return table;
}

cv::Mat luma(const cv::Mat& image) {
  if (image.channels() == 1) {
    cv::Mat grey;
    image.convertTo(grey, CV_64F);
    return grey;
  }
  cv::Mat grey(image.size(), CV_64F);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const auto& c = image.at<cv::Vec3b>(y, x);
      grey.at<double>(y, x) = 0.299 * c[2] + 0.587 * c[1] + 0.114 * c[0];
    }
  return grey;
}

cv::Mat window_mean(const cv::Mat& values) {
  static const cv::Mat kernel = cv::getGaussianKernel(11, 1.5, CV_64F);
  cv::Mat result;
  cv::sepFilter2D(values, result, CV_64F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REFLECT);
  return result(cv::Rect(5, 5, values.cols - 10, values.rows - 10)).clone();  // only whole windows
}

double hue_deg(double b, double a) {
  if (a == 0 && b == 0) return 0;
  const double angle = std::atan2(b, a) / kDegree;
  return angle < 0 ? angle + 360 : angle;
}

double power7(double x) { return x * x * x * x * x * x * x; }

}  // namespace

double psnr_db(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask) {
  double sum = 0, count = 0;
  for (int y = 0; y < a.rows; ++y)
    for (int x = 0; x < a.cols; ++x) {
      if (!mask.at<unsigned char>(y, x)) continue;
      for (int c = 0; c < a.channels(); ++c, ++count) {
        const double step = double(a.ptr(y)[x * a.channels() + c]) - b.ptr(y)[x * b.channels() + c];
        sum += step * step;
      }
    }
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return sum == 0 ? std::numeric_limits<double>::infinity() : 10 * std::log10(255.0 * 255.0 * count / sum);
}

cv::Mat ssim_map(const cv::Mat& a, const cv::Mat& b) {
  const double c1 = std::pow(0.01 * 255, 2), c2 = std::pow(0.03 * 255, 2);
  if (a.cols < 11 || a.rows < 11) return {};
  const cv::Mat x = luma(a), y = luma(b);
  const cv::Mat mx = window_mean(x), my = window_mean(y);
  const cv::Mat xx = window_mean(x.mul(x)), yy = window_mean(y.mul(y)), xy = window_mean(x.mul(y));
  cv::Mat map(mx.size(), CV_64F);
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.cols; ++column) {
      const double m1 = mx.at<double>(row, column), m2 = my.at<double>(row, column);
      const double v1 = xx.at<double>(row, column) - m1 * m1, v2 = yy.at<double>(row, column) - m2 * m2;
      const double cov = xy.at<double>(row, column) - m1 * m2;
      map.at<double>(row, column) = ((2 * m1 * m2 + c1) * (2 * cov + c2)) / ((m1 * m1 + m2 * m2 + c1) * (v1 + v2 + c2));
    }
  return map;
}

double masked_ssim(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask) {
  const cv::Mat map = ssim_map(a, b);
  std::vector<double> values;
  for (int y = 0; y < map.rows; ++y)
    for (int x = 0; x < map.cols; ++x)
      if (mask.at<unsigned char>(y + 5, x + 5)) values.push_back(map.at<double>(y, x));
  return mean(values);
}

double ciede2000(const std::array<double, 3>& lab1, const std::array<double, 3>& lab2) {
  const auto [l1, a1, b1] = lab1;
  const auto [l2, a2, b2] = lab2;
  const double mean_chroma7 = power7((std::hypot(a1, b1) + std::hypot(a2, b2)) / 2);
  const double g = 0.5 * (1 - std::sqrt(mean_chroma7 / (mean_chroma7 + kPower25To7)));
  const double c1 = std::hypot((1 + g) * a1, b1), c2 = std::hypot((1 + g) * a2, b2);
  const double h1 = hue_deg(b1, (1 + g) * a1), h2 = hue_deg(b2, (1 + g) * a2);
  double dh = h2 - h1;
  if (c1 * c2 == 0) dh = 0;
  if (dh > 180) dh -= 360;
  if (dh < -180) dh += 360;
  const double big_dh = 2 * std::sqrt(c1 * c2) * std::sin(dh / 2 * kDegree);
  const double l = (l1 + l2) / 2, c = (c1 + c2) / 2;
  double h = h1 + h2;
  if (c1 * c2 != 0) h = std::abs(h1 - h2) <= 180 ? h / 2 : (h < 360 ? (h + 360) / 2 : (h - 360) / 2);
  const double t = 1 - 0.17 * std::cos((h - 30) * kDegree) + 0.24 * std::cos(2 * h * kDegree) +
                   0.32 * std::cos((3 * h + 6) * kDegree) - 0.20 * std::cos((4 * h - 63) * kDegree);
  const double turn = 60 * std::exp(-std::pow((h - 275) / 25, 2));  // 2 delta theta
  const double rc = 2 * std::sqrt(power7(c) / (power7(c) + kPower25To7));
  const double sl = 1 + 0.015 * std::pow(l - 50, 2) / std::sqrt(20 + std::pow(l - 50, 2));
  const double sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
  const double dl = (l2 - l1) / sl, dc = (c2 - c1) / sc, dhue = big_dh / sh;
  return std::sqrt(std::max(0.0, dl * dl + dc * dc + dhue * dhue - std::sin(turn * kDegree) * rc * dc * dhue));
}

std::array<double, 3> lab_of_srgb(double red, double green, double blue) {
  const double r = linear_of(red / 255), g = linear_of(green / 255), b = linear_of(blue / 255);
  const double x = (0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047;
  const double y = 0.2126729 * r + 0.7151522 * g + 0.0721750 * b;
  const double z = (0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883;
  const auto f = [](double v) { return v > 216.0 / 24389 ? std::cbrt(v) : (24389.0 / 27 * v + 16) / 116; };
  return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

std::vector<double> color_differences(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask) {
  std::vector<double> differences;
  for (int y = 0; y < a.rows; ++y)
    for (int x = 0; x < a.cols; ++x) {
      if (!mask.at<unsigned char>(y, x)) continue;
      const auto &p = a.at<cv::Vec3b>(y, x), &q = b.at<cv::Vec3b>(y, x);
      differences.push_back(ciede2000(lab_of_srgb(p[2], p[1], p[0]), lab_of_srgb(q[2], q[1], q[0])));
    }
  return differences;
}

cv::Vec3d gain_to_match(const std::vector<cv::Mat>& estimates, const std::vector<cv::Mat>& truths,
                        const std::vector<cv::Mat>& masks) {
  const auto& linear = linear_table();
  cv::Vec3d of_estimate(0, 0, 0), of_truth(0, 0, 0);
  for (std::size_t i = 0; i < masks.size(); ++i)
    for (int y = 0; y < masks[i].rows; ++y)
      for (int x = 0; x < masks[i].cols; ++x) {
        if (!masks[i].at<unsigned char>(y, x)) continue;
        for (int c = 0; c < 3; ++c) {
          of_estimate[c] += linear[estimates[i].at<cv::Vec3b>(y, x)[c]];
          of_truth[c] += linear[truths[i].at<cv::Vec3b>(y, x)[c]];
        }
      }
  cv::Vec3d gain(1, 1, 1);
  for (int c = 0; c < 3; ++c)
    if (of_estimate[c] > 0 && of_truth[c] > 0) gain[c] = of_truth[c] / of_estimate[c];
  return gain;
}

cv::Mat with_gain(const cv::Mat& image, const cv::Vec3d& gain) {
  cv::Mat table(1, 256, CV_8UC3), result;
  for (int i = 0; i < 256; ++i)
    for (int c = 0; c < 3; ++c)
      table.at<cv::Vec3b>(0, i)[c] =
          cv::saturate_cast<unsigned char>(255 * srgb_of(std::min(1.0, linear_table()[i] * gain[c])));
  cv::LUT(image, table, result);
  return result;
}

}  // namespace dressform::metrics
