#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "pipeline/segment/jseg_colors.h"
#include "pipeline/segment/jseg_texture.h"

namespace dressform {

struct JsegParams {
  QuantizeParams colors;
  int scales = 2;       // passes, from the scale that fits a region's size down
  double uneven = 0.1;  // mean J of a region, at the scale it was parted at, above which the next pass parts it again
  double merge = 0.4;   // distance of two regions' histograms of classes below which they become one
};
template <class V>
void fields(V& v, JsegParams& p) {
  v("color_threshold", p.colors.threshold, 0, 600, "",
    "squared L*u*v* distance up to which colours are one class; 0: found between 260 and 400");
  v("classes", p.colors.classes, 0, 256, "", "of colours; 0: as many as color_threshold leaves");
  v("scales", p.scales, 1, 4, "", "passes, each at a finer scale; 1: coarse, 4: small regions in a large image");
  v("uneven", p.uneven, 0, 2, "",
    "mean J of a region above which the next pass parts it again; textures stay below 0.07, two that are mixed do not");
  v("merge", p.merge, 0, 1.42, "", "distance of two regions' class histograms below which they become one");
}

// Everything that JSEG finds on its way, each at the image's size.
struct JsegResult {
  ColorClasses colors;     // the class map
  std::vector<cv::Mat> j;  // float32 J-images of the first pass, [0] the finest scale; as many as it used
  cv::Mat valleys;         // int32: where the regions of the first pass began, 1 to valley_count; 0 elsewhere
  cv::Mat unmerged;        // int32: regions before merging, 1 to unmerged_count; 0 outside the mask
  cv::Mat regions;         // int32: regions, 1 to region_count, connected; 0 outside the mask
  int valley_count = 0, unmerged_count = 0, region_count = 0;
};

// Regions of even colour and texture. bgr: 8-bit sRGB; mask: uint8, 0 = not to be looked at; empty: the whole image.
// The same regions for any number of threads. Throws InputError for an image of another type, and a mask of another
// type or size. Deng and Manjunath, "Unsupervised segmentation of color-texture regions in images and video", PAMI
// 2001.
JsegResult jseg(const cv::Mat& bgr, const cv::Mat& mask, const JsegParams& params);

}  // namespace dressform
