#include "eval/report/joined_garments.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace dressform {
namespace {

cv::Mat shrunk(const cv::Mat& image, int height) {
  if (image.rows <= height) return image;
  cv::Mat small;
  cv::resize(image, small, {std::max(1, image.cols * height / image.rows), height}, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

TexturedMesh joined_garments(const std::map<std::string, TexturedMesh>& garments, int texture_px) {
  std::vector<std::pair<const TexturedMesh*, cv::Mat>> parts;
  int width = 0, height = 0;
  for (const auto& [slot, garment] : garments) {
    if (garment.mesh.triangles.empty() || garment.texture.empty()) continue;
    parts.push_back({&garment, shrunk(garment.texture, texture_px)});
    width += parts.back().second.cols;
    height = std::max(height, parts.back().second.rows);
  }
  TexturedMesh joined;
  if (parts.empty()) return joined;
  joined.texture = cv::Mat(height, width, CV_8UC3, cv::Scalar::all(128));
  int left = 0;
  for (const auto& [garment, image] : parts) {
    image.copyTo(joined.texture(cv::Rect(left, 0, image.cols, image.rows)));
    const int first = static_cast<int>(joined.mesh.vertices.size());
    const Mesh& mesh = garment->mesh;
    joined.mesh.vertices.insert(joined.mesh.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& triangle : mesh.triangles) joined.mesh.triangles.push_back(triangle + Vector3i::Constant(first));
    const Vector2f part(static_cast<float>(image.cols) / static_cast<float>(width),
                        static_cast<float>(image.rows) / static_cast<float>(height));
    const Vector2f offset(static_cast<float>(left) / static_cast<float>(width), 0);
    for (const auto& corners : garment->corner_uv) {
      std::array<Vector2f, 3> moved;
      for (int i = 0; i < 3; ++i) moved[i] = offset + corners[i].cwiseProduct(part);
      joined.corner_uv.push_back(moved);
    }
    left += image.cols;
  }
  return joined;
}

}  // namespace dressform
