#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace dressform {

// The first half of JSEG: colours to few classes.

// An image after peer group filtering.
struct PeerGroups {
  cv::Mat luv;     // float32 x 3, CIE L*u*v* (L 0-100) without noise and impulses, edges kept
  cv::Mat radius;  // float32: distance of the farthest peer, L*u*v* units: small where the image is smooth
};

// CIE L*u*v* of an 8-bit sRGB image (BGR order): float32 x 3, L 0-100.
cv::Mat luv_of(const cv::Mat& bgr);

// Each pixel becomes the mean of those of its 5 x 5 neighbours that are like it; the others, told apart by Fisher's
// criterion on their distances, and impulses are left out. Pixels outside `mask` (uint8) are neither asked nor changed.
// Deng, Kenney, Moore and Manjunath, "Peer group filtering and perceptual color image quantization", ISCAS 1999.
PeerGroups peer_group_filtered(const cv::Mat& luv, const cv::Mat& mask);

struct QuantizeParams {
  double threshold = 0;  // squared L*u*v* distance up to which classes are merged; 0: chosen between 260 and 400
  int classes = 0;       // instead of the threshold: merge until so many are left; 0: by threshold
};

struct ColorClasses {
  cv::Mat classes;             // int32: 0 to count - 1; -1 outside the mask
  std::vector<cv::Vec3f> luv;  // of the classes
  int count() const { return static_cast<int>(luv.size()); }
};

// Classes of colours: generalised Lloyd algorithm with splitting, in which pixels of smooth surroundings weigh more,
// then merging of the nearest ones. Same paper.
ColorClasses quantized(const PeerGroups& image, const cv::Mat& mask, const QuantizeParams& params);

}  // namespace dressform
