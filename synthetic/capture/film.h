#pragma once
#include <opencv2/core/mat.hpp>

#include "scenes/mesh.h"
#include "scenes/registry.h"

namespace dressform {

// How a colour camera turns light into numbers.
struct FilmSpec {
  float gain = 1;                             // linear; nominal exposure times the sensor's own
  Vector3f white_balance = Vector3f::Ones();  // linear, RGB
  float electrons_full_scale = 2500;          // at white; shot noise: about 10 electrons for one 8-bit step
  float read_noise_electrons = 3;
  float vignetting = 0.3f;  // part of the cos^4 law that the lens leaves uncorrected
  bool mosaic = true;       // one colour a pixel (Bayer, RGGB), the others interpolated along edges
  int jpeg_quality = 90;    // of the stream (4:2:0), 1-100; 0: uncompressed
};

// The image that light makes: shot and read noise, one colour filter a pixel and its interpolation, white balance,
// sRGB gamma, JPEG. `light`: CV_32FC3, linear RGB behind the lens, 1 = white before the gain. 8-bit BGR, decoded. Bytes
// depend on the arguments only.
cv::Mat developed(const cv::Mat& light, const FilmSpec& film, Seed seed);

}  // namespace dressform
