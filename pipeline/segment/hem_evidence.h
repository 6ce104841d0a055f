#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "pipeline/segment/view_evidence.h"

namespace dressform {

// A closed curve round the body on one view's crop.
struct CurveOnView {
  cv::Mat above_m;  // float32: metres above the curve; NaN where the pixel has no say
  cv::Mat column;   // uint8: direction round the body
};

// What speaks for two cloths that meet at a curve, rather than one cloth with a line drawn on it.
struct HemEvidence {
  double color_nats = 0;                  // that the colour of a pixel says for its side, on average
  double told_above = 0, told_below = 0;  // part of the pixels of a side whose colour says so at all
  double below_mm2 = 0;                   // of cloth below that was asked
};

// Colour models of both sides are learnt in every other sector of directions and asked in the remaining ones: what a
// print shows in one place does not pass for another cloth. Light may change from one side to the other, as far as one
// gain for all colours of a side explains it.
HemEvidence hem_evidence(const std::vector<ViewEvidence>& views, const std::vector<CurveOnView>& curve);

}  // namespace dressform
