#pragma once
#include "pipeline/segment/jseg_growing.h"
#include "scenes/registry.h"

namespace dressform {

// Regions of even colour, as one finds them without JSEG: each function below is a variant's own (its file has its
// name), and gives connected regions, labels from 1, 0 outside the mask. bgr: 8-bit; mask: uint8, 0 = not to be looked
// at; scale: of the whole image, its width over 1920, by which lengths and areas in pixels shrink.

// Connected pieces of equal keys (int32, 0 = outside) with what is smaller than least_px given to the pieces round it;
// what touches none stays a piece.
LabelMap pieces_of_keys(const cv::Mat& keys, int least_px);

struct MeanShiftParams {
  double spatial_px = 10, color = 10;  // radii of the windows; colour in 8-bit units of L*u*v*
  int levels = 1;                      // of the pyramid
  double join = 4;                     // largest step of a channel between neighbours of one region
  double least_px = 400;
};
LabelMap mean_shift_regions(const cv::Mat& bgr, const cv::Mat& mask, double scale, const MeanShiftParams& params);

struct KmeansParams {
  int clusters = 8, attempts = 3, iterations = 10;
  double least_px = 400;
};
LabelMap kmeans_regions(const cv::Mat& bgr, const cv::Mat& mask, double scale, const KmeansParams& params, Seed seed);

struct GlaMrfParams {
  double threshold = 0;   // squared L*u*v* distance up to which classes are merged; 0: found
  double smoothness = 1;  // nats of a pair of neighbours of different classes
  int sweeps = 10;        // at most
  double least_px = 400;
};
LabelMap gla_mrf_regions(const cv::Mat& bgr, const cv::Mat& mask, double scale, const GlaMrfParams& params);

}  // namespace dressform
