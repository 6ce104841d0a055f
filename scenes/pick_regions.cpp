#include "scenes/pick_regions.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "scenes/error.h"
#include "scenes/image_file.h"
#include "scenes/json_file.h"

namespace dressform {
namespace {

constexpr std::size_t kMostCorners = 100000;  // of all shapes of a file
constexpr double kOutside_px = 1;             // a corner on the edge of the window may lie beyond the image
constexpr int kShift = 8;                     // binary digits of a pixel's fraction

void check_side(const JsonValue& file, const char* name, int expected) {
  const int found = file.at(name).whole(1, 1 << 20);
  if (found == expected) return;
  file.at(name).fail(
      fmt::format("found {}; expected {}, as the sensor's colour image has it (drawn in another, or a "
                  "scaled, image?)",
                  found, expected));
}

// A corner in pixels with centres at whole numbers.
cv::Point2d corner_of(const JsonValue& value, cv::Size size) {
  const auto numbers = value.numbers(2);
  const cv::Point2d corner(numbers[0], numbers[1]);
  if (corner.x < -kOutside_px || corner.y < -kOutside_px || corner.x > size.width + kOutside_px ||
      corner.y > size.height + kOutside_px)
    value.fail(fmt::format("found a corner at ({:g}, {:g}); expected one inside the image of {} x {} pixels", corner.x,
                           corner.y, size.width, size.height));
  return {corner.x - 0.5, corner.y - 0.5};
}

std::vector<cv::Point2d> outline_of(const JsonValue& shape, cv::Size size) {
  std::string kind = shape.has("shape_type") ? shape.at("shape_type").text() : "polygon";
  const auto values = shape.at("points").elements();
  if (values.size() > kMostCorners)
    shape.at("points").fail(fmt::format("found {} corners; expected {} at most", values.size(), kMostCorners));
  std::vector<cv::Point2d> corners;
  for (const auto& value : values) corners.push_back(corner_of(value, size));
  if (kind == "rectangle" && corners.size() == 2)
    return {corners[0], {corners[1].x, corners[0].y}, corners[1], {corners[0].x, corners[1].y}};
  if (kind != "polygon" && kind != "rectangle")
    shape.at("shape_type").fail("found \"" + kind + "\"; expected polygon or rectangle");
  if (corners.size() < 3 || (kind == "rectangle" && corners.size() != 4))
    shape.at("points").fail(fmt::format("found {} corners; expected {}", corners.size(),
                                        kind == "polygon" ? "3 or more" : "2 opposite ones, or all 4"));
  return corners;
}

void draw(const std::vector<cv::Point2d>& outline, cv::Mat& mask) {
  std::vector<cv::Point> corners;
  for (const auto& corner : outline)
    corners.emplace_back(static_cast<int>(std::lround(corner.x * (1 << kShift))),
                         static_cast<int>(std::lround(corner.y * (1 << kShift))));
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(255), cv::LINE_8, kShift);
}

}  // namespace

std::map<std::string, cv::Mat> read_labelme(const std::filesystem::path& path, cv::Size size) {
  const JsonValue file = read_json(path);
  check_side(file, "imageWidth", size.width);
  check_side(file, "imageHeight", size.height);
  std::map<std::string, cv::Mat> masks;
  std::size_t corners = 0;
  for (const auto& shape : file.at("shapes").elements()) {
    const auto outline = outline_of(shape, size);
    corners += outline.size();
    if (corners > kMostCorners) file.at("shapes").fail(fmt::format("found more than {} corners", kMostCorners));
    cv::Mat& mask = masks[shape.at("label").text()];
    if (mask.empty()) mask = cv::Mat(size, CV_8UC1, cv::Scalar(0));
    draw(outline, mask);
  }
  if (masks.empty()) file.at("shapes").fail("found none; expected a polygon or rectangle at least");
  for (const auto& [label, mask] : masks)
    if (cv::countNonZero(mask) == 0) file.at("shapes").fail("found shapes named \"" + label + "\" that hold no pixel");
  return masks;
}

cv::Mat read_mask(const std::filesystem::path& file, cv::Size size) {
  cv::Mat mask = read_image(file, kIndexImage, size) != 0;
  if (cv::countNonZero(mask) == 0)
    throw InputError(file.string(), "found a mask with nothing inside; expected pixels that are not 0");
  return mask;
}

}  // namespace dressform
