#include "pipeline/texture/photo_consistency.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "scenes/small_solvers.h"

namespace dressform {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kFirstDamping = 1e-3;  // over the diagonal
constexpr double kHarder = 10, kEasier = 0.3, kHopeless = 1e6;
constexpr double kSettled_m = 1e-6;  // a step this small ends a view's way (radians at a metre alike)

struct LumaView {
  cv::Mat luma, across, down;  // float32: levels, and their derivatives a pixel
  double damping = kFirstDamping;
  bool settled = false;
};

LumaView luma_of(const ColorView& view) {
  LumaView result;
  cv::cvtColor(view.color, result.luma, cv::COLOR_BGR2GRAY);
  constexpr double kSobel = 1.0 / 8;  // of the 3 x 3 operator: to levels a pixel
  cv::Sobel(result.luma, result.across, CV_32F, 1, 0, 3, kSobel);
  cv::Sobel(result.luma, result.down, CV_32F, 0, 1, 3, kSobel);
  return result;
}

bool counts(const VertexSamples& samples, Eigen::Index v, Eigen::Index i, double least_facing) {
  return samples.trust(v, i) > 0 && samples.facing(v, i) >= least_facing;
}

// The luma that a view sees at a vertex, and its pixel and place before the camera.
bool look(const ColorView& view, const LumaView& image, const Vector3d& vertex, Vector2d& pixel, double& luma) {
  double z_m = 0;
  if (!view.project(vertex, pixel, z_m)) return false;
  if (pixel.x() < 1 || pixel.y() < 1 || pixel.x() >= image.luma.cols - 2 || pixel.y() >= image.luma.rows - 2)
    return false;
  luma = linear1(image.luma, pixel);
  return true;
}

// Mean luma of the vertices that at least two views see; NaN elsewhere.
std::vector<double> mean_luma(const Mesh& mesh, const std::vector<ColorView>& views,
                              const std::vector<LumaView>& images, const VertexSamples& samples, double least_facing) {
  std::vector<double> means(mesh.vertices.size(), std::nan(""));
  tbb::parallel_for(std::size_t{0}, means.size(), [&](std::size_t v) {
    double sum = 0;
    int seen = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
      Vector2d pixel;
      double luma = 0;
      if (!counts(samples, static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(i), least_facing)) continue;
      if (!look(views[i], images[i], mesh.vertices[v], pixel, luma)) continue;
      sum += luma;
      ++seen;
    }
    if (seen > 1) means[v] = sum / seen;
  });
  return means;
}

// Squared differences of a view from the means, summed, and how many; with their normal equations where asked.
struct Difference {
  double squares = 0;
  int count = 0;
  Matrix6d normal = Matrix6d::Zero();  // of a rotation and a shift of the camera frame
  Vector6d right = Vector6d::Zero();
};
Difference difference(const Mesh& mesh, const ColorView& view, const LumaView& image, const VertexSamples& samples,
                      Eigen::Index column, const std::vector<double>& means, double least_facing) {
  Difference result;
  for (std::size_t v = 0; v < means.size(); ++v) {
    Vector2d pixel;
    double luma = 0;
    if (std::isnan(means[v]) || !counts(samples, static_cast<Eigen::Index>(v), column, least_facing)) continue;
    if (!look(view, image, mesh.vertices[v], pixel, luma)) continue;
    const Vector3d p = view.camera_from_model * mesh.vertices[v];
    const double gx = linear1(image.across, pixel) * view.camera.fx / p.z();
    const double gy = linear1(image.down, pixel) * view.camera.fy / p.z();
    const Vector3d by_place(gx, gy, -(gx * p.x() + gy * p.y()) / p.z());
    Vector6d by_motion;
    by_motion << p.cross(by_place), by_place;
    const double miss = means[v] - luma;
    result.squares += miss * miss;
    ++result.count;
    result.normal += by_motion * by_motion.transpose();
    result.right += by_motion * miss;
  }
  return result;
}

Isometry3d motion_of(const Vector6d& step) {
  Isometry3d motion = Isometry3d::Identity();
  const Vector3d turn = step.head<3>();
  if (turn.norm() > 0) motion.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  motion.translation() = step.tail<3>();
  return motion;
}

ColorView moved(const ColorView& view, const Isometry3d& motion) {
  ColorView result = view;  // images are shared
  result.camera_from_model = motion * view.camera_from_model;
  result.eye = result.camera_from_model.inverse().translation();
  return result;
}

// One step, kept if it lowers the mean square.
void step_view(const Mesh& mesh, ColorView& view, LumaView& image, const VertexSamples& samples, Eigen::Index column,
               const std::vector<double>& means, double least_facing) {
  constexpr int kUnknowns = 6;
  const Difference now = difference(mesh, view, image, samples, column, means, least_facing);
  if (now.count <= kUnknowns || now.normal.trace() <= 0) return;
  Matrix6d damped = now.normal;
  damped.diagonal() *= 1 + image.damping;
  damped.diagonal().array() += image.damping * now.normal.trace() / kUnknowns;
  const Vector6d step = solve_symmetric(damped, now.right);
  if (!step.allFinite()) return;
  const ColorView trial = moved(view, motion_of(step));
  const Difference then = difference(mesh, trial, image, samples, column, means, least_facing);
  const bool better = then.count > 0 && then.squares / then.count < now.squares / now.count;
  if (better) view = trial;
  image.damping *= better ? kEasier : kHarder;
  image.settled = image.damping > kHopeless || (better && step.norm() < kSettled_m);
}

std::vector<LumaView> luma_images(const std::vector<ColorView>& views) {
  std::vector<LumaView> images;
  for (const ColorView& view : views) images.push_back(luma_of(view));
  return images;
}

}  // namespace

double color_spread(const Mesh& mesh, const std::vector<ColorView>& views, const VertexSamples& samples,
                    const PhotoConsistencyParams& params) {
  const std::vector<LumaView> images = luma_images(views);
  const std::vector<double> means = mean_luma(mesh, views, images, samples, params.least_facing);
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Difference each =
        difference(mesh, views[i], images[i], samples, static_cast<Eigen::Index>(i), means, params.least_facing);
    squares += each.squares;
    count += each.count;
  }
  return count ? std::sqrt(squares / count) : 0;
}

std::vector<ColorView> photo_consistent(const Mesh& mesh, std::vector<ColorView> views, const VertexSamples& samples,
                                        const PhotoConsistencyParams& params) {
  std::vector<LumaView> images = luma_images(views);
  for (int round = 0; round < params.rounds; ++round) {
    const std::vector<double> means = mean_luma(mesh, views, images, samples, params.least_facing);
    tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
      if (!images[i].settled)
        step_view(mesh, views[i], images[i], samples, static_cast<Eigen::Index>(i), means, params.least_facing);
    });
  }
  return views;
}

}  // namespace dressform
