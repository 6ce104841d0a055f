#pragma once
#include <functional>

#include "pipeline/fill/fill.h"
#include "pipeline/fill/garment_depth.h"
#include "pipeline/fill/holes.h"

namespace dressform {

// One garment in one view with its hole, before the hole has colours.
struct GarmentView {
  std::string sensor;
  Label label = Label::none;
  FilledGarment garment;  // complete but for the colours under mask == 128
  cv::Mat labels;         // the segmentation of the view
  ColorDepthMap map;      // of the filled depth
  SensorCalibration calibration;
  Isometry3d model_from_sensor;
};

// Gives colours to one view's filled pixels (mask == 128 of views[index]); returns the 8-bit BGR image.
using ColorFill = std::function<cv::Mat(const std::vector<GarmentView>& views, std::size_t index)>;

// Holes that a person picked, in place of those that are found.
struct PickedHoles {
  // Of a garment ("top", "bottom") in a sensor's colour image: uint8, 255 inside, at its size; empty: none.
  std::function<cv::Mat(const std::string& slot, const std::string& sensor)> region;
  bool depth = false;  // whether depth is made up for what is hidden in them; else they have colours alone
};

// What all variants share: certain depth, holes and their depth, masks; `color` then paints each view. Views without
// registration or without the garment have empty masks.
FilledViews fill_views(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                       const Registration& registration, const Segmentation& segmentation,
                       const GarmentDepthParams& depth, const HoleParams& holes, const ColorFill& color,
                       const PickedHoles* picked = nullptr);

// Description of the shared parameters, for the variants' fields().
template <class V>
void shared_fields(V& v, GarmentDepthParams& depth, HoleParams& holes) {
  v("edge_jump_mm", depth.edge_jump_mm, 5, 200, "mm", "pixels beside a larger step of depth are dropped");
  v("ambiguous_px", depth.ambiguous_px, 0, 20, "px", "pixels with another label this near are dropped, at 1920 x 1080");
  v("nearer_mm", holes.nearer_mm, 5, 200, "mm", "what hides a garment is at least this much nearer");
  v("bridge_px", holes.bridge_px, 0, 10, "px", "depth pixels without label that a hole may run across");
  v("least_px", holes.least_px, 1, 1000, "px", "depth pixels of the smallest hole that is filled");
}

}  // namespace dressform
