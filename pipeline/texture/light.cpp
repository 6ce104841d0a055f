#include "pipeline/texture/light.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/geometry/mesh_query.h"
#include "pipeline/texture/color_view.h"
#include "pipeline/texture/gains.h"

namespace dressform {
namespace {

constexpr std::size_t kLeastReadings = 1000;  // for 14 terms, and some of them outliers
constexpr std::size_t kPlaces = 12000;        // about as many vertices are looked at in every view
constexpr double kLeastFacing = 0.35;         // more oblique ones are near outlines, and glossy
constexpr double kOffSurface_m = 1e-3;        // where rays to the camera start
constexpr double kInFront_m = 0.05;           // z from which a point is before the camera
constexpr double kBlurPx = 1.5;               // over which colour is averaged: the noise
constexpr int kPasses = 8;                    // of reweighting
constexpr double kScale = 0.04;               // of the log's residual, in Cauchy's weight
constexpr double kPull = 1e-6;                // of all unknowns towards 0, over one reading
constexpr double kLeastExplained = 0.5;       // of the variance: else it is not light that colours the body
constexpr double kMiddle_m = 1;               // height where its terms are zero
constexpr double kLargestLog = 1;             // light is taken off by no more than this factor's log

using Terms = Eigen::Matrix<double, 1, Light::kTerms>;

Terms terms_of(const Vector3d& point, const Vector3d& n) {
  const double h = point.y() - kMiddle_m;
  Terms terms;
  terms << 1, n.x(), n.y(), n.z(), n.x() * n.y(), n.y() * n.z(), n.x() * n.z(), n.x() * n.x() - n.z() * n.z(),
      3 * n.y() * n.y() - 1, h, h * n.x(), h * n.y(), h * n.z(), h * h;
  return terms;
}

// What one sensor says of one place.
struct Reading {
  Terms terms;
  int sensor = 0;
  Eigen::RowVector3d log_level;  // BGR, of linear light
};

// Log of the linear light at a pixel, or nothing where it is clipped or outside the image.
std::optional<Eigen::RowVector3d> log_level_at(const cv::Mat& levels, const Vector2d& pixel) {
  if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= levels.cols - 1 && pixel.y() <= levels.rows - 1)) return {};
  const cv::Vec3f level = linear3(levels, pixel);
  Eigen::RowVector3d logs;
  for (int c = 0; c < 3; ++c) {
    if (!is_usable_level(level[c])) return {};
    logs[c] = std::log(linear_of_level(level[c]));
  }
  return logs;
}

// Every so many vertices of the body that a camera sees, with their colours in its image.
void read_view(const MeshQuery& body, const std::vector<Vector3d>& normals, const cv::Mat& color, const Camera& camera,
               const Isometry3d& camera_from_model, int sensor, std::vector<Reading>& readings) {
  const Vector3d eye = camera_from_model.inverse().translation();
  cv::Mat levels;
  color.convertTo(levels, CV_32FC3);
  cv::GaussianBlur(levels, levels, {}, kBlurPx);
  const std::size_t step = std::max<std::size_t>(1, normals.size() / kPlaces);
  for (std::size_t v = 0; v < normals.size(); v += step) {
    const Vector3d &point = body.mesh().vertices[v], to_eye = eye - point, p = camera_from_model * point;
    if (normals[v].dot(to_eye) < kLeastFacing * to_eye.norm() || !(p.z() > kInFront_m)) continue;
    const auto log_level = log_level_at(levels, camera.project(p));
    if (!log_level || body.first_hit(point + kOffSurface_m * normals[v], to_eye)) continue;
    readings.push_back({terms_of(point, normals[v]), sensor, *log_level});
  }
}

std::vector<Reading> readings_of(const BodyModel& naked, const std::map<std::string, Shot>& shots,
                                 const Calibration& calibration, const Registration& registration) {
  const MeshQuery body(naked.body);
  const std::vector<Vector3d> normals = vertex_normals(naked.body);
  std::vector<Reading> readings;
  int sensor = 0;
  for (const auto& [name, shot] : shots) {
    const auto pose = registration.model_from_sensor.find(name);
    const auto calibrated = calibration.sensors.find(name);
    if (shot.color.empty() || pose == registration.model_from_sensor.end() || calibrated == calibration.sensors.end() ||
        !calibrated->second.color)
      continue;
    read_view(body, normals, shot.color, *calibrated->second.color,
              calibrated->second.color_from_ir * pose->second.inverse(), sensor++, readings);
  }
  return readings;
}

// One channel's equations: the light's terms, then one factor for each sensor.
class ChannelFit {
 public:
  ChannelFit(const std::vector<Reading>& readings, int channel) : readings_(readings), channel_(channel) {
    for (const Reading& r : readings) sensors_ = std::max(sensors_, r.sensor + 1);
    solution_ = Eigen::VectorXd::Zero(Light::kTerms + sensors_);
    for (int pass = 0; pass < kPasses; ++pass) solve(pass > 0);
  }

  Eigen::Matrix<double, Light::kTerms, 1> light() const { return solution_.head<Light::kTerms>(); }

  // Part of the variance within the sensors that the light explains.
  double explained() const {
    std::vector<double> sum(sensors_, 0), count(sensors_, 0);
    for (const Reading& r : readings_) {
      sum[r.sensor] += r.log_level[channel_];
      ++count[r.sensor];
    }
    double left = 0, all = 0;
    for (const Reading& r : readings_) {
      left += std::pow(residual(r), 2);
      all += std::pow(r.log_level[channel_] - sum[r.sensor] / count[r.sensor], 2);
    }
    return all > 0 ? 1 - left / all : 1;  // even light needs no explanation
  }

 private:
  double residual(const Reading& r) const {
    return r.terms * light() + solution_[Light::kTerms + r.sensor] - r.log_level[channel_];
  }

  void solve(bool robust) {
    const Eigen::Index unknowns = solution_.size();
    // The weak pull settles how much of the mean is the sensors'.
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(unknowns, unknowns) * (kPull * static_cast<double>(readings_.size()));
    Eigen::VectorXd b = Eigen::VectorXd::Zero(unknowns), row(unknowns);
    for (const Reading& r : readings_) {
      row.setZero();
      row.head<Light::kTerms>() = r.terms.transpose();
      row[Light::kTerms + r.sensor] = 1;
      const double weight = robust ? 1 / (1 + std::pow(residual(r) / kScale, 2)) : 1;
      a.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
      b += weight * r.log_level[channel_] * row;
    }
    solution_ = a.selfadjointView<Eigen::Lower>().ldlt().solve(b);
  }

  const std::vector<Reading>& readings_;
  int channel_, sensors_ = 0;
  Eigen::VectorXd solution_;
};

}  // namespace

Eigen::RowVector3d Light::log_irradiance(const Vector3d& point, const Vector3d& normal) const {
  return terms_of(point, normal) * coefficients_;
}

std::optional<Light> light_on(const BodyModel& naked, const std::map<std::string, Shot>& shots,
                              const Calibration& calibration, const Registration& registration) {
  const std::vector<Reading> readings = readings_of(naked, shots, calibration, registration);
  if (readings.size() < kLeastReadings) return {};
  Light::Coefficients coefficients;
  for (int c = 0; c < 3; ++c) {
    const ChannelFit fit(readings, c);
    if (fit.explained() < kLeastExplained) return {};
    coefficients.col(c) = fit.light();
  }
  return Light(coefficients);
}

Eigen::MatrixXf unlit_gains(const Light& light, const Mesh& mesh, double part) {
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  Eigen::MatrixXd logs(normals.size(), 3);
  for (std::size_t v = 0; v < normals.size(); ++v) logs.row(v) = light.log_irradiance(mesh.vertices[v], normals[v]);
  if (logs.rows() > 0) logs.rowwise() -= logs.colwise().mean().eval();
  return (-part * logs).cwiseMax(-kLargestLog).cwiseMin(kLargestLog).array().exp().cast<float>();
}

}  // namespace dressform
