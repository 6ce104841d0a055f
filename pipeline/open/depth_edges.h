#pragma once
#include <map>
#include <string>
#include <vector>

#include "pipeline/geometry/mesh_query.h"
#include "pipeline/imaging/depth_view.h"
#include "pipeline/open/openings.h"
#include "pipeline/open/rim_fit.h"
#include "pipeline/segment/segment.h"

namespace dressform {

struct DepthEdgeParams {
  double least_gap_m = 0.020;      // cloth nearer to the skin is not told from it by depth that errs by bounced light
  int inside_px = 2;               // depth pixels that have to show cloth on one side of an edge ...
  int outside_px = 2;              // ... and what lies behind it on the other
  int most_missing_px = 4;         // without depth in between
  double least_cosine = 0.25;      // edges on surface seen at a lower n.v are outlines
  double least_rise = 0.5;         // part of the way across an edge that has to lead out of the garment
  double contradiction_m = 0.010;  // mask edges this far from the same view's depth edges are dropped
};

// Rim points of a garment by depth alone, by opening: where a sensor stops measuring the closed surface, which runs on
// beyond the rims, and measures the body behind it. They scatter by a depth pixel, but know nothing of colours, prints
// and shadows, and reach below the colour camera's image. Cloth on the skin, as at necks, or on other clothes ends
// unseen. What is behind is the same sensor's naked shot, unless the mannequin moved since, as it errs alike.
std::map<std::string, std::vector<RimSample>> depth_rim_samples(
    const Segmentation& segmentation, Label garment, const CaptureSession& session, const std::vector<DepthView>& views,
    const MeshQuery& closed, const MeshQuery& naked, const Landmarks& limbs, const std::vector<Opening>& openings,
    const DepthEdgeParams& params);

// Both kinds of samples of one rim. A mask edge is the finer one, and stays unless depth of the same view shows the end
// of the cloth in that direction and only elsewhere.
std::vector<RimSample> reconciled(const std::vector<RimSample>& mask_edges, const std::vector<RimSample>& depth_edges,
                                  double contradiction_m);

}  // namespace dressform
