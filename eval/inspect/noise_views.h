#pragma once
#include <map>
#include <string>
#include <vector>

#include "eval/inspect/depth_noise.h"
#include "scenes/capture_session.h"

namespace dressform {

// One view: frames from one place, of one sensor.
struct View {
  Camera camera;
  std::vector<cv::Mat> frames;
};

// All depth of one sensor model.
struct ModelViews {
  std::vector<View> views;
  int frames = 0, repeated = 0;  // repeated: of views that were taken more than once
  int copies = 0;                // frames that equal an earlier one of their view, bit for bit: left out
  bool nominal = false;
};

// By the model that calibrations name ("unknown" where they name none). A sensor of the rig stands still between its
// naked and its dressed shot: the room is seen twice. Of a scan, each run from one place is a view; all other frames,
// up to thirty evenly spread, are views of their own.
std::map<std::string, ModelViews> views_by_model(const CaptureSession& session);

// Smooth windows of all views: noise from pixel to pixel, and from frame to frame.
struct Windows {
  std::vector<SmoothWindow> space, time;
};
Windows windows_of(const ModelViews& model);

// Those at a distance and an incidence within [from, to).
std::vector<SmoothWindow> chosen(const std::vector<SmoothWindow>& windows, double from_m, double to_m, double from_rad,
                                 double to_rad);

long pixels_of(const std::vector<SmoothWindow>& windows);

}  // namespace dressform
