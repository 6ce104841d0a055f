#include "eval/figures/run_views.h"

#include <algorithm>
#include <cctype>
#include <opencv2/imgproc.hpp>

#include "eval/report/image_tools.h"
#include "eval/report/run_counts.h"
#include "scenes/label.h"

namespace dressform {
namespace {

constexpr double kRoom = 0.06;  // round the mannequin, of its size
const char* const kSides[] = {"front", "left", "back", "right"};

const ViewMasks* masks_of(const FigureInput& input, const std::string& sensor) {
  const auto& views = input.made.extracted.get().views;
  const auto found = views.find(sensor);
  return found == views.end() || !found->second.found_dressed ? nullptr : &found->second;
}

cv::Mat dressed_color(const FigureInput& input, const std::string& sensor) {
  const auto shot = input.session.dressed.find(sensor);
  return shot == input.session.dressed.end() ? cv::Mat() : shot->second.color;
}

// The part of the colour image that all pictures of a sensor show.
cv::Rect frame_of(const FigureInput& input, const std::string& sensor) {
  const ViewMasks* masks = masks_of(input, sensor);
  return masks ? box_around(masks->dressed_color, kRoom) : cv::Rect();
}

const FilledGarment* filled_garment(const FigureInput& input, const std::string& sensor, const std::string& slot) {
  const auto& garments = input.made.filled.get().garments;
  const auto garment = garments.find(slot);
  if (garment == garments.end()) return nullptr;
  const auto view = garment->second.find(sensor);
  return view == garment->second.end() || view->second.color.empty() ? nullptr : &view->second;
}

cv::Mat on_white(const cv::Mat& color, const cv::Mat& mask, const cv::Rect& frame) {
  if (color.empty() || mask.empty() || frame.empty()) return {};
  cv::Mat image(color.size(), CV_8UC3, cv::Scalar::all(255));
  color.copyTo(image, mask);
  return image(frame).clone();
}

Eigen::Vector3f color_of_view(std::size_t view) {
  const Ink ink = palette_ink(static_cast<int>(1 + view % 6));
  return Eigen::Vector3f(static_cast<float>(ink.red), static_cast<float>(ink.green), static_cast<float>(ink.blue)) /
         255;
}

}  // namespace

std::vector<RunView> run_views(const FigureInput& input) {
  std::vector<RunView> views;
  const auto& poses = input.made.registration.get().model_from_sensor;
  for (const char* side : kSides)
    for (const auto& sensor : input.made.sensors) {
      const auto pose = poses.find(sensor);
      if (pose == poses.end()) continue;
      std::string seen = view_of(input.made.landmarks.get(), pose->second.translation());
      seen[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(seen[0])));
      if (seen == side) views.push_back({sensor, seen});
    }
  return views;
}

std::vector<RunView> views_of_sides(const FigureInput& input, const std::vector<std::string>& sides) {
  std::vector<RunView> chosen;
  for (const auto& view : run_views(input))
    if (std::count(sides.begin(), sides.end(), view.side) > 0) chosen.push_back(view);
  return chosen;
}

cv::Mat dressed_picture(const FigureInput& input, const std::string& sensor) {
  const cv::Mat color = dressed_color(input, sensor);
  const cv::Rect frame = frame_of(input, sensor);
  return color.empty() || frame.empty() ? cv::Mat() : color(frame).clone();
}

cv::Mat cut_out(const FigureInput& input, const std::string& sensor, const cv::Mat& mask) {
  return on_white(dressed_color(input, sensor), mask, frame_of(input, sensor));
}

cv::Mat labelled_garment(const FigureInput& input, const std::string& sensor, const std::string& slot) {
  const auto& labels = input.made.segmentation.get().labels;
  const auto found = labels.find(sensor);
  if (found == labels.end()) return {};
  const Label label = slot == "top" ? Label::top : Label::bottom;
  const cv::Mat mask = found->second == static_cast<int>(label);
  return cv::countNonZero(mask) == 0 ? cv::Mat() : cut_out(input, sensor, mask);
}

cv::Mat garment_before_filling(const FigureInput& input, const std::string& sensor, const std::string& slot) {
  const FilledGarment* garment = filled_garment(input, sensor, slot);
  return garment ? cut_out(input, sensor, garment->mask == 255) : cv::Mat();
}

cv::Mat garment_after_filling(const FigureInput& input, const std::string& sensor, const std::string& slot) {
  const FilledGarment* garment = filled_garment(input, sensor, slot);
  return garment ? on_white(garment->color, garment->mask, frame_of(input, sensor)) : cv::Mat();
}

PointCloud naked_points(const FigureInput& input, const std::string& only_sensor) {
  PointCloud cloud;
  const auto& poses = input.made.registration.get().model_from_sensor;
  for (std::size_t view = 0; view < input.made.sensors.size(); ++view) {
    const std::string& sensor = input.made.sensors[view];
    const auto pose = poses.find(sensor);
    const auto masks = input.made.extracted.get().views.find(sensor);
    if ((!only_sensor.empty() && sensor != only_sensor) || pose == poses.end() ||
        masks == input.made.extracted.get().views.end() || masks->second.naked.empty())
      continue;
    const auto& calibration = input.made.calibration.get().sensors.at(sensor);
    const cv::Mat& depth = input.session.naked.at(sensor).depth_mm;
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u) {
        const double z = depth.at<unsigned short>(v, u) * 0.001 - calibration.depth_offset_m;
        if (z <= 0 || !masks->second.naked.at<unsigned char>(v, u)) continue;
        cloud.points.push_back(pose->second * calibration.ir.unproject({u, v}, z));
        cloud.colors.push_back(color_of_view(view));
      }
  }
  return cloud;
}

PointCloud garment_points(const FigureInput& input, const std::string& slot) {
  PointCloud cloud;
  const auto& poses = input.made.registration.get().model_from_sensor;
  for (std::size_t view = 0; view < input.made.sensors.size(); ++view) {
    const std::string& sensor = input.made.sensors[view];
    const auto pose = poses.find(sensor);
    const FilledGarment* garment = filled_garment(input, sensor, slot);
    if (!garment || pose == poses.end()) continue;
    const auto& calibration = input.made.calibration.get().sensors.at(sensor);
    for (int v = 0; v < garment->depth_mm.rows; ++v)
      for (int u = 0; u < garment->depth_mm.cols; ++u) {
        const double z = 0.001 * garment->depth_mm.at<float>(v, u);
        if (!(z > 0)) continue;
        cloud.points.push_back(pose->second * calibration.ir.unproject({u, v}, z));
        cloud.colors.push_back(color_of_view(view));
      }
  }
  return cloud;
}

cv::Mat seen_by(const FigureInput& input, const std::string& sensor, const std::vector<RenderItem>& items) {
  const auto& poses = input.made.registration.get().model_from_sensor;
  const auto pose = poses.find(sensor);
  const auto& calibration = input.made.calibration.get().sensors.at(sensor);
  const cv::Rect frame = frame_of(input, sensor);
  if (pose == poses.end() || !calibration.color || frame.empty()) return {};
  RenderView view;
  view.camera = *calibration.color;  // pinhole: the lens's distortion moves a garment by a pixel or two
  view.camera.distortion = {0, 0, 0, 0, 0};
  view.camera.width = frame.width, view.camera.height = frame.height;
  view.camera.cx -= frame.x, view.camera.cy -= frame.y;
  view.camera_from_world = calibration.color_from_ir * pose->second.inverse();
  return input.renderer.render(view, items);
}

}  // namespace dressform
