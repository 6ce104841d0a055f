#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

namespace dressform {

// How far two pictures lie apart. A mean hides a hole: 64 wrong pixels of 33,000 by 200 levels make it 0.4. So the
// worst tile counts beside it, and FLIP, which weighs what an eye sees.
struct PictureDifference {
  double mean_levels = 0;        // of the absolute difference, over all pixels and channels
  double worst_tile_levels = 0;  // the same over the worst tile of 16 x 16 pixels
  double flip = 0;               // mean of FLIP (eval/metrics/flip.h)
  double worst_tile_flip = 0;    // over the worst tile
  int tile_x = 0, tile_y = 0;    // top left corner of the worst tile by levels
  bool comparable = true;        // false: another size or kind; all numbers are the largest there are
};

// Tiles lie 8 pixels apart, so that any 8 x 8 pixels are wholly inside one. Symmetric.
PictureDifference picture_difference(const cv::Mat& a, const cv::Mat& b);

// How far each of the numbers may go; the declared ones where no nuisance was measured.
struct PictureTolerance {
  // Anti-aliased edges and dithering of texture filtering differ between instruction sets, surfaces do not: at most
  // every second pixel along an edge by a quarter of the contrast. An edge of dark cloth against white that goes
  // through a tile makes that 1.2 levels and a FLIP of 0.031 there, and 0.007 over a picture of such edges; an 8 x 8
  // hole of ten levels makes 2.5 levels and 0.069.
  double mean_levels = 1, worst_tile_levels = 2, flip = 0.01, worst_tile_flip = 0.04;
  bool measured = false;

  // How many times over the tolerance the worst of the numbers is: above 1, the pictures are not the same.
  double excess(const PictureDifference& difference) const;
};

// Whether two pictures are not the same by this tolerance: as `excess` above 1, but FLIP is only asked where levels do
// not tell.
bool told_apart(const cv::Mat& a, const cv::Mat& b, const PictureTolerance& tolerance = {});

// "mean 0.41 levels, worst tile 12.50 at (104, 32), FLIP 0.0031, worst tile 0.0920".
std::string picture_text(const PictureDifference& difference);

}  // namespace dressform
