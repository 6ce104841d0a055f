#pragma once
#include <vector>

#include "pipeline/segment/segment.h"
#include "pipeline/segment/top_bottom.h"
#include "pipeline/segment/view_evidence.h"

namespace dressform {

// What all variants begin and end with.

// The evidence of each of the session's sensors, in their order; that of a view without shot, mask, calibration or pose
// has an empty box.
std::vector<ViewEvidence> gather_views(const CaptureSession& session, const Calibration& calibration,
                                       const NakedBody& body, const ExtractedViews& extracted,
                                       const Registration& registration, const EvidenceParams& params);

// Label images and layouts from the masks of top and bottom; the rest of each view's body is skin. A garment that
// `parted` says is there has a layout, its kind told by where its pixels lie.
Segmentation labelled_views(const CaptureSession& session, const Calibration& calibration, const NakedBody& body,
                            const std::vector<ViewEvidence>& views, const TopBottom& parted);

}  // namespace dressform
