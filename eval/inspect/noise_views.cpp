#include "eval/inspect/noise_views.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "eval/inspect/session_cameras.h"

namespace dressform {
namespace {

// Frames that equal none before them: a copy has the noise of its original, and would make noise over time vanish.
std::vector<cv::Mat> without_copies(const std::vector<cv::Mat>& all) {
  std::vector<cv::Mat> frames;
  for (const auto& each : all) {
    const auto same = [&](const cv::Mat& other) {
      return other.size() == each.size() && cv::norm(other, each, cv::NORM_INF) == 0;
    };
    if (std::none_of(frames.begin(), frames.end(), same)) frames.push_back(each);
  }
  return frames;
}

void add_view(std::map<std::string, ModelViews>& models, const CaptureSession& session, const std::string& sensor,
              const std::vector<cv::Mat>& all) {
  const std::vector<cv::Mat> frames = without_copies(all);
  const InspectedSensor inspected = inspected_sensor(session, sensor, frames.front().size());
  ModelViews& model = models[inspected.calibration.model.empty() ? "unknown" : inspected.calibration.model];
  model.views.push_back({inspected.calibration.ir, frames});
  model.frames += static_cast<int>(frames.size());
  model.nominal = model.nominal || inspected.nominal;
  if (frames.size() > 1) model.repeated += static_cast<int>(frames.size());
  model.copies += static_cast<int>(all.size() - frames.size());
}

}  // namespace

std::map<std::string, ModelViews> views_by_model(const CaptureSession& session) {
  std::map<std::string, ModelViews> models;
  for (const auto& sensor : session.sensors) {
    std::vector<cv::Mat> frames;
    for (const auto* shots : {&session.naked, &session.dressed})
      if (const auto found = shots->find(sensor); found != shots->end()) frames.push_back(found->second.depth_mm);
    if (!frames.empty()) add_view(models, session, sensor, frames);
    if (session.boards && session.boards->shots.count(sensor))
      for (const auto& shot : session.boards->shots.at(sensor)) add_view(models, session, sensor, {shot.depth_mm});
  }
  for (const auto& [name, scan] : session.scans) {
    constexpr int kFramesOfRun = 100, kFramesOfWalk = 30;  // enough to know the noise by, and quickly looked at
    const auto runs = still_runs(scan.depth_mm);
    for (const auto& run : runs) {
      const auto first = scan.depth_mm.begin() + run.first;
      add_view(models, session, scan.sensor, {first, first + std::min(run.frames, kFramesOfRun)});
    }
    const std::size_t step = std::max<std::size_t>(1, scan.depth_mm.size() / kFramesOfWalk);
    if (runs.empty())
      for (std::size_t i = 0; i < scan.depth_mm.size(); i += step)
        add_view(models, session, scan.sensor, {scan.depth_mm[i]});
  }
  return models;
}

Windows windows_of(const ModelViews& model) {
  Windows windows;
  for (const auto& view : model.views) {
    const auto space = smooth_windows(view.frames.front(), view.camera);
    windows.space.insert(windows.space.end(), space.begin(), space.end());
    const auto time = windows_over_time(view.frames, view.camera);
    windows.time.insert(windows.time.end(), time.begin(), time.end());
  }
  return windows;
}

std::vector<SmoothWindow> chosen(const std::vector<SmoothWindow>& windows, double from_m, double to_m, double from_rad,
                                 double to_rad) {
  std::vector<SmoothWindow> result;
  for (const auto& window : windows)
    if (window.z_m >= from_m && window.z_m < to_m && window.theta_rad >= from_rad && window.theta_rad < to_rad)
      result.push_back(window);
  return result;
}

long pixels_of(const std::vector<SmoothWindow>& windows) {
  long pixels = 0;
  for (const auto& window : windows) pixels += window.pixels.area();
  return pixels;
}

}  // namespace dressform
