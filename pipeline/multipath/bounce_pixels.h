#pragma once
#include "pipeline/multipath/bounce_field.h"

namespace dressform {

// What tells how strongly a pixel is lit directly.
struct PixelLight {
  cv::Mat ir;                // infrared image of the same size; empty: the geometry alone tells
  double signal_counts = 0;  // amplitude of a white surface that faces the camera at 1 m
};

// The image less factor x error, pixel by pixel. Bounced light changes slowly within a surface and is interpolated
// between its cells; the direct light does not: on the sides of a limb it fades within a few pixels, and the same
// bounced light bends depth the more. It comes from the normal in the depth image, and where that is oblique, and so
// uncertain, from the infrared amplitude as well: albedo is as the surface's about it, or shading makes it darker.
cv::Mat without_bounce(const cv::Mat& depth_mm, const SurfaceCells& cells, const BouncedLight& light,
                       const PixelLight& pixels, const DepthOptics& optics, double factor);

}  // namespace dressform
