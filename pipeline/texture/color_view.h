#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "pipeline/texture/texture.h"

namespace dressform {

struct ViewParams {
  double erode_m = 0.005;        // taken off the masks, so that neither skin nor background bleeds in
  double feather_m = 0.006;      // over which trust rises to 1
  double occluder_m = 0.005;     // half width of the window in which an occluder is looked for
  double occluder_gap_m = 0.03;  // how much nearer an occluder must be
  double band_m = 0.018;         // standard deviation of the blur that divides the bands, on the garment
  double filled_trust = 0;       // in colours that fill made up, against 1 in those that were seen
  double denoise = 5;            // range of the bilateral filter over the noise found in the image; 0: none
  double chroma_px = 2;          // over which chroma is averaged where the luma is alike; 0: none
};

// Colours as the sensor gave them: neither denoised nor with calmer chroma.
ViewParams as_photographed();

// The thesis's projection (section 3.5): colours as photographed, filled in ones trusted like those that were seen, and
// no test of visibility.
ViewParams projected_blindly();

// One garment in the raw colour image of one registered sensor, cropped to the garment.
struct ColorView {
  std::string sensor;
  Camera camera;                 // of the whole image
  Isometry3d camera_from_model;  // colour camera
  Vector3d eye;                  // the colour camera's centre, model frame
  Vector2d origin;               // pixel of the crop's first pixel
  cv::Mat color;                 // float32 x 3, BGR, sRGB levels 0-255
  cv::Mat low;                   // float32 x 3, the colour blurred within the mask
  cv::Mat trust;                 // float32: 1 well inside what was seen, less where filled in, 0 outside
  cv::Mat occluder_m;            // float32: z of the nearest surface within the window

  float filled_trust = 0;  // trust up to this is in filled-in pixels

  // Raw pixel of the crop, or nothing behind the camera.
  bool project(const Vector3d& point, Vector2d& pixel, double& z_m) const;
  // Trust at a pixel of the crop and depth, 0 where hidden. Linear between pixels.
  float trust_at(const Vector2d& pixel, double z_m, double occluder_gap_m) const;
};

// The views of one garment, in the order of the sensors of the session; views that are not registered, whose sensor
// has no colour camera or whose mask is empty are left out. `scenery`: all surfaces that may hide the garment,
// itself among them.
std::vector<ColorView> color_views(const std::vector<std::string>& sensors, const Calibration& calibration,
                                   const Registration& registration, const std::map<std::string, FilledGarment>& filled,
                                   const Mesh& garment, const std::vector<const Mesh*>& scenery,
                                   const ViewParams& params);

// Value of a float image between pixels, linear and bicubic (Catmull-Rom); the edge pixels are repeated.
cv::Vec3f linear3(const cv::Mat& image, const Vector2d& pixel);
float linear1(const cv::Mat& image, const Vector2d& pixel);
cv::Vec3f cubic3(const cv::Mat& image, const Vector2d& pixel);

}  // namespace dressform
