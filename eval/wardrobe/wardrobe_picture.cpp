#include "eval/wardrobe/wardrobe_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "render/renderer.h"

namespace dressform {
namespace {

constexpr double kHalfWidth_m = 0.55;  // of a place: arms held out as mannequins do
constexpr double kAspect = 0.58;       // width of a place over its height
constexpr double kElevation_deg = 4, kFov_deg = 20;
constexpr int kCaption_px = 26;
const Eigen::Vector3f kSkin(0.86f, 0.72f, 0.63f);  // of the bodies, RGB

// A box about the body as tall and wide as all of them, with the body's axis in its middle and its floor at the bottom.
RenderView view_of(const KnownBody& body, double tallest_m, int width, int height) {
  const Landmarks& known = body.landmarks;
  const Vector3d low(known.axis.x() - kHalfWidth_m, known.floor_y, known.axis.z() - kHalfWidth_m);
  const Vector3d high(known.axis.x() + kHalfWidth_m, known.floor_y + tallest_m, known.axis.z() + kHalfWidth_m);
  const double azimuth_deg = std::atan2(known.front.x(), known.front.z()) * 180 / M_PI;
  return look_at_box(low, high, azimuth_deg, kElevation_deg, width, height, kFov_deg);
}

cv::Mat captioned(const cv::Mat& image, const std::string& text) {
  cv::Mat result;
  cv::copyMakeBorder(image, result, 0, kCaption_px, 0, 0, cv::BORDER_CONSTANT, cv::Scalar::all(255));
  constexpr double kFont = 0.5;
  int below = 0;
  const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFont, 1, &below);
  cv::putText(result, text, {std::max(2, (image.cols - size.width) / 2), image.rows + kCaption_px - 9},
              cv::FONT_HERSHEY_SIMPLEX, kFont, cv::Scalar::all(40), 1, cv::LINE_AA);
  return result;
}

cv::Mat pictured(Renderer& renderer, const PicturedBody& place, double tallest_m, const cv::Size& size) {
  if (!place.body) return captioned(cv::Mat(size, CV_8UC3, cv::Scalar::all(255)), place.caption);
  std::vector<RenderItem> items;
  RenderItem body;
  body.mesh = &place.body->body;
  body.color = kSkin;
  items.push_back(body);
  if (place.clothes)
    for (const auto& [slot, garment] : place.clothes->garments) {
      RenderItem item;
      item.textured = &garment;
      item.shading = Shading::textured;
      items.push_back(item);
    }
  return captioned(renderer.render(view_of(*place.body, tallest_m, size.width, size.height), items), place.caption);
}

}  // namespace

cv::Mat wardrobe_picture(const std::vector<std::vector<PicturedBody>>& rows, int tile_height) {
  double tallest_m = 0;
  std::size_t columns = 0;
  for (const auto& row : rows) {
    columns = std::max(columns, row.size());
    for (const PicturedBody& place : row)
      if (place.body) tallest_m = std::max(tallest_m, place.body->landmarks.top_y - place.body->landmarks.floor_y);
  }
  if (columns == 0) return {};
  const cv::Size size(static_cast<int>(std::lround(kAspect * tile_height)), tile_height);
  Renderer renderer;
  std::vector<cv::Mat> lines;
  for (const auto& row : rows) {
    std::vector<cv::Mat> places;
    for (const PicturedBody& place : row) places.push_back(pictured(renderer, place, tallest_m, size));
    while (places.size() < columns) places.push_back(pictured(renderer, {}, tallest_m, size));
    cv::Mat line;
    cv::hconcat(places, line);
    lines.push_back(line);
  }
  cv::Mat picture;
  cv::vconcat(lines, picture);
  return picture;
}

}  // namespace dressform
