#include "eval/report/error_images.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/geometry/mesh_query.h"
#include "render/color_map.h"

namespace dressform {
namespace {

constexpr int kHeight = 460;
constexpr double kScaleMm = 10;
constexpr double kMostDifference = 25;  // just noticeable is 2.3; from here on colours are simply other ones

Mesh moved(const Mesh& mesh, const Isometry3d& target_from_source) {
  return transformed(mesh, target_from_source.matrix());
}

Figure heat_map(const std::string& name, const std::string& title, const Mesh& mesh, const Mesh& truth,
                Renderer& renderer) {
  RenderItem item;
  item.mesh = &mesh;
  item.shading = Shading::scalar;
  item.scalars = vertex_distances_mm(mesh, truth);
  item.scalar_minimum = 0;
  item.scalar_maximum = kScaleMm;
  const cv::Mat image = with_color_bar(four_views(renderer, {item}, kHeight), 0, kScaleMm, "mm", "distance to truth");
  return {name, title, "Distance of the reconstruction to the true surface: front, left, back, right.", image};
}

RenderItem unlit(const TexturedMesh& mesh) {
  RenderItem item;
  item.textured = &mesh;
  item.shading = Shading::unlit;
  return item;
}

// The estimate and the truth, seen from between the sensors.
ImageComparison beside_truth(const std::string& slot, const TexturedMesh& truth, const TexturedMesh& estimate,
                             Renderer& renderer) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : truth.mesh.vertices) box.extend(vertex);
  std::vector<RenderView> views;
  for (const double azimuth : {45.0, 135.0, 225.0, 315.0})
    views.push_back(look_at_box(box.min(), box.max(), azimuth, 5, 340, kHeight));
  const cv::Mat made = side_by_side(renderer.render(views, {unlit(estimate)}), kHeight);
  const cv::Mat reference = side_by_side(renderer.render(views, {unlit(truth)}), kHeight);
  const cv::Mat difference = difference_image(made, reference, kMostDifference);
  const auto padded = [&](const cv::Mat& image) {  // as wide as the one with the colour bar, to lie on one another
    cv::Mat wide;
    cv::copyMakeBorder(image, wide, 0, 0, 0, difference.cols - image.cols, cv::BORDER_CONSTANT, cv::Scalar::all(255));
    return wide;
  };
  return {"heldout_" + slot,
          slot + " beside the true one",
          "Unlit texture from 45, 135, 225 and 315 degrees, where no sensor stood. Difference: CIE76 in L*a*b*.",
          padded(made),
          padded(reference),
          difference};
}

}  // namespace

std::vector<double> vertex_distances_mm(const Mesh& mesh, const Mesh& truth) {
  const MeshQuery query(truth);
  std::vector<double> result(mesh.vertices.size());
  tbb::parallel_for(std::size_t{0}, result.size(),
                    [&](std::size_t i) { result[i] = 1000 * query.closest(mesh.vertices[i]).distance; });
  return result;
}

cv::Mat difference_image(const cv::Mat& made, const cv::Mat& reference, double most) {
  cv::Mat lab[2], grey(made.size(), CV_8UC1), colors;
  for (int i = 0; i < 2; ++i) {
    (i == 0 ? made : reference).convertTo(lab[i], CV_32FC3, 1.0 / 255);
    cv::cvtColor(lab[i], lab[i], cv::COLOR_BGR2Lab);
  }
  for (int y = 0; y < made.rows; ++y)
    for (int x = 0; x < made.cols; ++x) {
      const double apart = cv::norm(lab[0].at<cv::Vec3f>(y, x) - lab[1].at<cv::Vec3f>(y, x));
      grey.at<unsigned char>(y, x) = cv::saturate_cast<unsigned char>(255 * apart / most);
    }
  cv::applyColorMap(grey, colors, scalar_colors());
  return with_color_bar(colors, 0, most, "", "difference");
}

ErrorImages error_images(const Reconstruction& made, const GroundTruth& truth, Renderer& renderer) {
  ErrorImages images;
  const auto& poses = made.registration.get().model_from_sensor;
  const auto first = made.sensors.empty() ? poses.end() : poses.find(made.sensors.front());
  if (first == poses.end() || !truth.world_from_sensor.count(made.sensors.front())) return images;
  const Isometry3d world_from_model = truth.world_from_sensor.at(made.sensors.front()) * first->second.inverse();
  const Mesh& body = made.naked.get().body;
  if (!body.triangles.empty() && !truth.naked_body.triangles.empty())
    images.maps.push_back(
        heat_map("error_body", "Scanned mannequin", moved(body, world_from_model), truth.naked_body, renderer));
  for (const auto& [slot, garment] : made.textured.get().garments) {
    const auto real = truth.garments.find(slot);
    if (real == truth.garments.end()) continue;
    const TexturedMesh estimate{moved(garment.mesh, world_from_model), garment.corner_uv, garment.texture};
    images.maps.push_back(heat_map("error_" + slot, slot, estimate.mesh, real->second.mesh, renderer));
    if (!real->second.textured.texture.empty())
      images.beside_truth.push_back(beside_truth(slot, real->second.textured, estimate, renderer));
  }
  return images;
}

}  // namespace dressform
