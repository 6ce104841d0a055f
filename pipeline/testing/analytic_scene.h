#pragma once
#include <functional>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/fuse/fuse.h"
#include "pipeline/registration/registration.h"
#include "scenes/capture_session.h"

namespace dressform::analytic {

// For tests only: a mannequin of capsules with clothes of thicker capsules, in a room of a floor and a wall, seen by
// four sensors at right angles. Everything is known in closed form, labels included.
struct SceneOptions {
  double scale = 0.25;          // of the images
  double noise_mm = 2.5;        // of the depth
  double color_noise = 2;       // of the 8-bit colours
  double wall_behind_m = 0.45;  // of the mannequin, as seen by k1
  bool skirt = false;           // else trousers
  bool top = true, bottom = true;
  bool dress = false;           // top and skirt in one piece, all of it top
  double shirt_hem_y_m = 0.93;  // over the floor
  double leg_end_y_m = 0.15;    // of trousers, over the floor
  double shirt_ease_m = 0.018, bottom_ease_m = 0.012;
  std::function<cv::Vec3b(const Vector3d&)> top_color, bottom_color;  // BGR by place; empty: plain
  Seed seed = 1;
};
struct AnalyticScene {
  CaptureSession session;
  Calibration calibration;
  BodyModel naked;                        // in the model frame, which here is the world
  KnownBody body;                         // the same, with its landmarks
  Registration registration;              // true
  std::map<std::string, cv::Mat> labels;  // truth at colour size: 0 none, 1 skin, 2 top, 3 bottom
};
AnalyticScene make_scene(const SceneOptions& options = {});

// Intersection over union of one label; 1 when both are empty.
double label_iou(const cv::Mat& found, const cv::Mat& truth, int label);

}  // namespace dressform::analytic
