#pragma once
#include <vector>

#include "synthetic/capture/ir_view.h"
#include "synthetic/sensors/tof_samples.h"

namespace dressform {

// Multipath of one bounce over a whole view: gathered on a coarse grid of pixels from small patches of what the
// emitter lights, and interpolated within each surface. Surfaces outside the image are outside the emitter's cone as
// well.
class BounceMap {
 public:
  // strength: 0: none; 1: all surfaces are matt and send on what they reflect.
  BounceMap(const IrView& view, double falloff, double strength);
  // Terms of a row of pixels: tof::bounce_terms arrays of the view's width, one after the other. `depth_m`: what the
  // row's pixels see.
  void row(int y, const float* depth_m, float* terms) const;

 private:
  static void keep_one_surface(const float (&depths)[4], float depth_m, float (&weights)[4]);
  void mix(int corner, const float (&weights)[4], float* terms) const;

  int width_, edge_, columns_ = 0, rows_ = 0;  // edge_: pixels between two points of the grid
  std::vector<float> grid_;                    // by row, term, column
  std::vector<float> depth_m_;                 // of the grid's points
};

}  // namespace dressform
