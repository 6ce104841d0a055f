#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "pipeline/imaging/smooth_windows.h"

namespace dressform {

// The smooth windows of the first frame, with the deviation from frame to frame of one view instead: mean over the
// window of each pixel's variance, less that of the window's mean. Windows in which a pixel is a hole now and then, or
// whose mean moves, are left out.
std::vector<SmoothWindow> windows_over_time(const std::vector<cv::Mat>& frames, const Camera& camera, int edge_px = 15);

// Runs of frames in a scan from a sensor that stood still: first frame and number, five frames at least.
struct StillRun {
  int first = 0, frames = 0;
};
std::vector<StillRun> still_runs(const std::vector<cv::Mat>& frames);

// The middle of the windows' deviations, millimetres; NaN without windows.
double median_sigma_mm(const std::vector<SmoothWindow>& windows);

}  // namespace dressform
