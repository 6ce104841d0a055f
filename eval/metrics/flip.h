#pragma once
#include <opencv2/core/mat.hpp>

namespace dressform::metrics {

// Pixels per degree of the viewing conditions that FLIP's authors propose: 0.7 m from a screen of 3840 pixels on 0.7 m.
constexpr double kFlipPixelsPerDegree = 67;

// FLIP for images of low dynamic range: how different two images look when flipped between, 0 (the same) to 1, at every
// pixel. In: 8-bit BGR (sRGB), of one size. Out: CV_32FC1 of that size. Colour differences are taken after the eye's
// contrast sensitivity at the given resolution, and raised where edges or points differ. Symmetric. Deterministic.
// Throws std::invalid_argument for images of other types or of two sizes.
// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and Fairchild, "FLIP: a difference evaluator for alternating
// images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020.
cv::Mat flip_map(const cv::Mat& a, const cv::Mat& b, double pixels_per_degree = kFlipPixelsPerDegree);

// Mean of the map.
double flip_mean(const cv::Mat& a, const cv::Mat& b, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace dressform::metrics
