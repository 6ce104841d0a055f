#include "eval/gate/power/fault_shapes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace dressform {
namespace {

Vector3d box_centre(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertices) box.extend(vertex);
  return box.isEmpty() ? Vector3d(Vector3d::Zero()) : Vector3d(box.center());
}

// The vertex that a placement picks.
Vector3d spot_of(const Mesh& mesh, const Placement& place) {
  const auto k = static_cast<std::size_t>(place.uniform(7) * static_cast<double>(mesh.vertices.size()));
  return mesh.vertices[std::min(k, mesh.vertices.size() - 1)];
}

}  // namespace

void blow(Mesh& mesh, double distance_m) {
  const auto normals = vertex_normals(mesh);
  for (std::size_t k = 0; k < normals.size(); ++k) mesh.vertices[k] += distance_m * normals[k];
}

void shake(Mesh& mesh, double sigma_m, const Placement& place) {
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) mesh.vertices[k][axis] += sigma_m * place.normal(1000 + 3 * k + axis);
}

void shift(Mesh& mesh, const Vector3d& by_m) {
  for (auto& vertex : mesh.vertices) vertex += by_m;
}

void scale_about_centre(Mesh& mesh, double factor) {
  const Vector3d centre = box_centre(mesh);
  for (auto& vertex : mesh.vertices) vertex = centre + factor * (vertex - centre);
}

void turn_about_centre(Mesh& mesh, double angle_deg, const Vector3d& axis) {
  const Vector3d centre = box_centre(mesh);
  const Eigen::AngleAxisd turn(angle_deg * M_PI / 180, axis.normalized());
  for (auto& vertex : mesh.vertices) vertex = centre + turn * (vertex - centre);
}

std::vector<int> triangles_at_a_spot(const Mesh& mesh, double radius_m, const Placement& place) {
  std::vector<int> found;
  if (mesh.vertices.empty()) return found;
  const Vector3d spot = spot_of(mesh, place);
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& t = mesh.triangles[k];
    const Vector3d centroid = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    if ((centroid - spot).norm() < radius_m) found.push_back(static_cast<int>(k));
  }
  return found;
}

void dent(Mesh& mesh, double radius_m, double depth_m, const Placement& place) {
  if (mesh.vertices.empty()) return;
  const Vector3d spot = spot_of(mesh, place);
  const auto normals = vertex_normals(mesh);
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    const double r = (mesh.vertices[k] - spot).norm() / radius_m;
    if (r < 1) mesh.vertices[k] -= depth_m * (1 - r * r) * (1 - r * r) * normals[k];
  }
}

void shift_image(cv::Mat& image, int right, int down) {
  if (image.empty()) return;
  const cv::Matx23d by(1, 0, right, 0, 1, down);
  cv::Mat moved;
  cv::warpAffine(image, moved, by, image.size(), cv::INTER_NEAREST, cv::BORDER_REPLICATE);
  image = moved;
}

void multiply_image(cv::Mat& image, double factor) {
  if (!image.empty()) image.convertTo(image, image.type(), factor);
}

void add_levels(cv::Mat& image, double levels) {
  if (!image.empty()) image.convertTo(image, image.type(), 1, levels);
}

void blur_image(cv::Mat& image, double sigma_px) {
  if (!image.empty()) cv::GaussianBlur(image.clone(), image, {0, 0}, sigma_px);
}

void grow_mask(cv::Mat& mask, int pixels) {
  if (mask.empty() || pixels == 0) return;
  const int side = 2 * std::abs(pixels) + 1;
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
  cv::Mat result;
  if (pixels > 0)
    cv::dilate(mask, result, disc);
  else
    cv::erode(mask, result, disc);
  mask = result;
}

void square_hole(cv::Mat& image, int side_px, const cv::Scalar& value, const Placement& place) {
  if (image.empty()) return;
  const int side = std::min({side_px, image.cols, image.rows});
  const int x = std::min(image.cols - side, static_cast<int>(image.cols * (0.25 + 0.5 * place.uniform(8))));
  const int y = std::min(image.rows - side, static_cast<int>(image.rows * (0.25 + 0.5 * place.uniform(9))));
  image(cv::Rect(x, y, side, side)).setTo(value);
}

}  // namespace dressform
