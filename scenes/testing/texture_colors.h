#pragma once
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "scenes/mesh.h"

namespace dressform {

// The nearest texel at (u, v), v down, of the image repeated without end.
inline cv::Vec3b image_at(const cv::Mat& image, double u, double v) {
  const int x = static_cast<int>(std::floor(u * image.cols)), y = static_cast<int>(std::floor(v * image.rows));
  const auto within = [](int i, int size) { return (i % size + size) % size; };
  return image.at<cv::Vec3b>(within(y, image.rows), within(x, image.cols));
}

// Bilinear between texel centres.
inline cv::Vec3b bilinear_at(const cv::Mat& image, double u, double v) {
  const double x = u * image.cols - 0.5, y = v * image.rows - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  cv::Vec3d sum(0, 0, 0);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double weight = (i ? x - x0 : 1 - x + x0) * (j ? y - y0 : 1 - y + y0);
      const cv::Vec3b texel =
          image.at<cv::Vec3b>(std::clamp(y0 + j, 0, image.rows - 1), std::clamp(x0 + i, 0, image.cols - 1));
      for (int k = 0; k < 3; ++k) sum[k] += weight * texel[k];
    }
  return {cv::saturate_cast<std::uint8_t>(sum[0]), cv::saturate_cast<std::uint8_t>(sum[1]),
          cv::saturate_cast<std::uint8_t>(sum[2])};
}

enum class Read { nearest, bilinear };

// Calls visit(triangle, place, colour) at points all over the triangles, none on their edges.
template <class Visit>
void for_points(const TexturedMesh& mesh, const Visit& visit, Read read = Read::nearest) {
  constexpr int kSteps = 23;
  for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t)
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; i + j < kSteps; ++j) {
        const double b = (i + 0.31) / (kSteps + 1), c = (j + 0.33) / (kSteps + 1), a = 1 - b - c;
        const auto& uv = mesh.corner_uv[t];
        const Eigen::Vector2d at = a * uv[0].cast<double>() + b * uv[1].cast<double>() + c * uv[2].cast<double>();
        const Vector3i& corner = mesh.mesh.triangles[t];
        const Vector3d place =
            a * mesh.mesh.vertices[corner[0]] + b * mesh.mesh.vertices[corner[1]] + c * mesh.mesh.vertices[corner[2]];
        visit(t, place,
              read == Read::bilinear ? bilinear_at(mesh.texture, at.x(), at.y())
                                     : image_at(mesh.texture, at.x(), at.y()));
      }
}

}  // namespace dressform
