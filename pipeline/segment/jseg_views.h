#pragma once
#include <vector>

#include "pipeline/segment/jseg_growing.h"
#include "pipeline/segment/jseg_regions.h"
#include "pipeline/segment/view_evidence.h"

namespace dressform {

// The JSEG regions of each view's mannequin, at the size of its crop; empty for views of no use. Views as gather_views
// makes them of this session.
std::vector<LabelMap> jseg_views(const CaptureSession& session, const std::vector<ViewEvidence>& views,
                                 const JsegParams& params);

}  // namespace dressform
