#pragma once
#include <vector>

#include "pipeline/geometry/lattice.h"
#include "scenes/camera.h"
#include "scenes/frame.h"
#include "scenes/mesh.h"

namespace dressform {

// The raw frames of a scan with their poses: what they see through is empty.
struct ScanViews {
  const DepthScan& scan;
  const SensorCalibration& calibration;
  const std::vector<Isometry3d>& model_from_frame;
  const std::vector<char>& used;
};

struct FreeSpaceOptions {
  int least_views = 2;      // that saw through a point, for it to be empty
  double margin_m = 0.10;   // so far behind the point they saw something else
  double support_m = 0.02;  // behind a measured surface all is body
};

// How many frames saw through each of the points (model frame): the pixel there measures something farther away. Pixels
// without depth say nothing. Takes raw pixels, not cleaned ones: a slit two pixels wide has no pixel off its edges.
std::vector<int> count_free_space_violations(const std::vector<Vector3d>& points, const ScanViews& views,
                                             double margin_m);

struct Carved {
  std::vector<float> field;
  int points = 0;  // of the lattice that are no longer inside
};

// The field (metres, negative inside) with what was seen through taken out: points inside that no measured surface has
// close in front of it and that enough frames saw through. A surface closed over holes makes webs between thighs and
// under arms; there the sensor sees the slit's far end, but its walls only at grazing angles. Space carving (Kutulakos
// and Seitz, IJCV 2000) where nothing was measured and nowhere else: contours are seen a little too narrow by some
// frames, so that only places deeper than a step, and what is seen through beside them, count.
Carved carved(const Lattice& lattice, std::vector<float> field, const PointCloud& measured, const ScanViews& views,
              const FreeSpaceOptions& options);

}  // namespace dressform
