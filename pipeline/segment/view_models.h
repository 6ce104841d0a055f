#pragma once
#include <vector>

#include "pipeline/imaging/color_histogram.h"
#include "pipeline/segment/view_evidence.h"

namespace dressform {

// One colour model a view, learnt from images[k] where masks[k] != 0 (empty = nothing), with a share of what the other
// views learnt: exposure and print differ between views, but a view that saw little leans on the others.
// shades: the same colours in shadow are added with a small weight.
std::vector<ColorHistogram> shared_models(const std::vector<cv::Mat>& masks, const std::vector<cv::Mat>& images,
                                          bool shades = false);

// A Lab colour (8-bit) in other light: the 8-bit values scale together, and so nearly do lightness and chroma.
cv::Vec3b shaded(const cv::Vec3b& lab, float gain);

// The views' smoothed_lab images.
std::vector<cv::Mat> lab_images(const std::vector<ViewEvidence>& views);

// `mask` less what is within `times` pixels of its edge.
cv::Mat eroded(const cv::Mat& mask, int times);

// Turns over pieces of either value inside `body` that cover less than speck_mm2. px_mm: size of a pixel on the body.
void remove_specks(cv::Mat& mask, const cv::Mat& body, double speck_mm2, double px_mm);

// Size of a pixel on the mannequin where it faces the camera, mm; 2 when no place is known.
double pixel_size_mm(const ViewEvidence& view);

}  // namespace dressform
