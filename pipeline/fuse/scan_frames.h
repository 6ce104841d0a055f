#pragma once
#include <vector>

#include "pipeline/imaging/depth_map.h"
#include "scenes/frame.h"

namespace dressform {

// The frames of a scan, ready for tracking.
struct ScanFrames {
  std::vector<cv::Mat> depth_m;           // cleaned, full size; empty Mat for a frame without enough depth
  std::vector<DepthMap> maps;             // shrunken to at most ~256 pixels across
  std::vector<std::vector<int>> samples;  // per frame: indices into its map, spread evenly over directions of normals
  std::vector<char> usable;               // enough depth
  double noise_factor = 1;                // of the sensor over the usual curve, by some of its frames
  int count() const { return static_cast<int>(maps.size()); }
  const DepthMap& first_usable() const;  // throws std::logic_error when there is none
};

// samples_per_direction: how many points of each of the ~200 bins of normal directions are kept (normal-space
// sampling; Rusinkiewicz and Levoy, 3DIM 2001), so that the floor does not outvote the body.
ScanFrames prepare_frames(const DepthScan& scan, const SensorCalibration& calibration, int samples_per_direction,
                          double max_depth_m);

}  // namespace dressform
