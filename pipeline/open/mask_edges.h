#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/geometry/mesh_query.h"
#include "pipeline/imaging/depth_view.h"
#include "pipeline/open/openings.h"
#include "pipeline/open/rim_fit.h"
#include "pipeline/segment/segment.h"

namespace dressform {

struct MaskEdgeParams {
  int inside_px = 3;           // the garment's label has to hold this far on one side of an edge ...
  int outside_px = 4;          // ... and any other label on the other
  double least_cosine = 0.25;  // edges on surface seen at a lower n.v are outlines, not rims
  double in_front_m = 0.025;   // something this much nearer than the surface hides the rim
  double goes_on_m = 0.015;    // the closed surface has to go on this far beyond a rim
  double least_rise = 0.5;     // ... mostly along the limb: across it, the edge is an outline
};

// Rim points of a garment, by opening: pixels where its mask ends although the closed surface goes on, thrown back on
// that surface. Outlines, edges made by something in front (an arm, the garment worn `over` it) are left out.
std::map<std::string, std::vector<RimSample>> rim_samples(const Segmentation& segmentation, Label garment,
                                                          std::optional<Label> over, const CaptureSession& session,
                                                          const std::vector<DepthView>& views, const MeshQuery& closed,
                                                          const MeshQuery& naked, const Landmarks& limbs,
                                                          const std::vector<Opening>& openings,
                                                          const MaskEdgeParams& params);

}  // namespace dressform
