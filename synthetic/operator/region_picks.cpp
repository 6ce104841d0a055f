#include "synthetic/operator/region_picks.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "scenes/label.h"
#include "scenes/random.h"
#include "scenes/smooth_block.h"

namespace dressform {
namespace {

constexpr int kBlock_px = 31;        // thesis, section 3.2.2
constexpr int kLeastBlock_px = 5;    // in small images, or where little cloth is seen
constexpr int kCoarse_px = 4;        // steps in which cloth behind an arm is looked for
constexpr double kOutline_px = 1.5;  // that an outline of few corners may leave the true one by
constexpr double kSpeck = 1e-3;      // part of a region's area below which nobody draws an outline
constexpr double kFar_m = 10;

// The outlines of a mask as a hand draws them, filled.
cv::Mat drawn(const cv::Mat& mask, double click_px, Seed seed, const std::string& name) {
  std::vector<std::vector<cv::Point>> outlines, kept;
  cv::findContours(mask, outlines, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  const double least = kSpeck * cv::countNonZero(mask);
  const std::uint64_t stream = stream_of(("operator/" + name).c_str());
  std::uint64_t index = 0;
  for (const auto& outline : outlines) {
    if (cv::contourArea(outline) < least) continue;
    std::vector<cv::Point> corners;
    cv::approxPolyDP(outline, corners, kOutline_px, true);
    for (auto& corner : corners) {
      const auto error = normal4(seed, stream, index++);
      corner.x += static_cast<int>(std::lround(click_px * error[0]));
      corner.y += static_cast<int>(std::lround(click_px * error[1]));
    }
    kept.push_back(std::move(corners));
  }
  cv::Mat result(mask.size(), CV_8UC1, cv::Scalar(0));
  if (!kept.empty()) cv::fillPoly(result, kept, cv::Scalar(255));
  return result;
}

// The clothes without the body, to see what of them an arm hides.
RayScene clothes_alone(const WornGarments& worn) {
  std::vector<RaySurface> surfaces;
  for (const auto& [slot, garment] : worn) {
    RaySurface surface;
    surface.mesh = garment->textured.mesh;
    surface.label = slot == "top" ? Label::top : Label::bottom;
    surfaces.push_back(std::move(surface));
  }
  return RayScene(std::move(surfaces));
}

// What lies behind skin: the label of the cloth whose outer side is first there; coarse.
cv::Mat behind_skin(const RayScene& clothes, const cv::Mat& labels, const SensorSpec& sensor) {
  const Isometry3d world_from_color = sensor.world_from_sensor * sensor.calibration.color_from_ir.inverse();
  const Vector3f eye = world_from_color.translation().cast<float>();
  cv::Mat behind(labels.rows / kCoarse_px, labels.cols / kCoarse_px, CV_8UC1, cv::Scalar(0));
  for (int y = 0; y < behind.rows; ++y)
    for (int x = 0; x < behind.cols; ++x) {
      const cv::Point pixel(x * kCoarse_px + kCoarse_px / 2, y * kCoarse_px + kCoarse_px / 2);
      if (labels.at<std::uint8_t>(pixel) != static_cast<int>(Label::skin)) continue;
      const Vector2d ideal = sensor.calibration.color->normalized(Vector2d(pixel.x, pixel.y));
      const Vector3f direction = (world_from_color.linear() * Vector3d(ideal.x(), ideal.y(), 1)).cast<float>();
      RayPacket rays;
      rays.set(0, eye, direction, 0, static_cast<float>(kFar_m));
      HitPacket hits;
      clothes.intersect(rays, hits, Coherence::incoherent);
      if (hits.surface[0] >= 0 && hits.geometric_normal(0).dot(direction) < 0)
        behind.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(clothes.surfaces()[hits.surface[0]].label);
    }
  return behind;
}

// The garment's outline with what an arm hides of it.
cv::Mat with_hidden(const cv::Mat& mask, const cv::Mat& behind, Label label) {
  cv::Mat coarse = behind == static_cast<int>(label), fine, cracks;
  if (cv::countNonZero(coarse) == 0) return mask;
  cv::resize(coarse, fine, mask.size(), 0, 0, cv::INTER_NEAREST);
  const auto element = [](int size) { return cv::getStructuringElement(cv::MORPH_RECT, {size, size}); };
  cv::morphologyEx(mask | fine, cracks, cv::MORPH_CLOSE, element(2 * kCoarse_px + 1));
  return cracks;
}

// The smoothest block of cloth; smaller ones where none of the thesis's size fits. Empty: none does.
cv::Rect lending_block(const cv::Mat& color, const cv::Mat& mask) {
  cv::Rect block;
  for (int size = kBlock_px; block.empty(); size = std::max(size / 2 | 1, kLeastBlock_px)) {
    block = smoothest_block(color, mask, size);
    if (size <= kLeastBlock_px) break;
  }
  return block;
}

void keep(Picks& picks, const std::string& name, const cv::Mat& mask) {
  if (cv::countNonZero(mask) > 0) picks.regions[name] = mask;
}

}  // namespace

void draw_regions(const WornGarments& worn, const std::vector<SensorSpec>& rig,
                  const std::map<std::string, cv::Mat>& labels, const std::map<std::string, Shot>& shots,
                  double click_px, Seed seed, Picks& picks) {
  const RayScene clothes = clothes_alone(worn);
  const std::pair<const char*, Label> things[] = {
      {"skin", Label::skin}, {"top", Label::top}, {"bottom", Label::bottom}};
  for (const auto& sensor : rig) {
    if (!labels.count(sensor.name)) continue;
    const cv::Mat& true_labels = labels.at(sensor.name);
    const cv::Mat behind = behind_skin(clothes, true_labels, sensor);
    for (const auto& [thing, label] : things) {
      const cv::Mat mask = true_labels == static_cast<int>(label);
      const std::string ending = std::string(thing) + "_" + sensor.name;
      keep(picks, "label_" + ending, drawn(mask, click_px, seed, "label_" + ending));
      if (label == Label::skin || cv::countNonZero(mask) == 0) continue;
      const cv::Mat whole = with_hidden(mask, behind, label);
      keep(picks, "region_" + ending, drawn(whole, click_px, seed, "region_" + ending));
      const cv::Rect block = lending_block(shots.at(sensor.name).color, mask);
      if (block.empty()) continue;
      cv::Mat& smooth = picks.regions["smooth_" + ending] = cv::Mat(mask.size(), CV_8UC1, cv::Scalar(0));
      smooth(block) = 255;
    }
  }
}

}  // namespace dressform
