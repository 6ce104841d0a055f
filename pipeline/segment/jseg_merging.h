#pragma once
#include "pipeline/segment/jseg_growing.h"

namespace dressform {

// Regions of like texture that touch become one: again and again the two whose normalised histograms of classes are
// nearest (Euclidean distance, 0 to sqrt 2), as long as they are nearer than `distance`. Labels are 1 to count in the
// order of the regions' first pixels. classes: int32, 0 to class_count - 1.
LabelMap merged(const LabelMap& regions, const cv::Mat& classes, int class_count, double distance);

}  // namespace dressform
