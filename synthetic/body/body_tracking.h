#pragma once
#include "scenes/frame.h"
#include "synthetic/body/body.h"
#include "synthetic/capture/ir_view.h"

namespace dressform {

// The SDK's body index: the true silhouette of body and clothes on the depth grid, with a wavering outline, lost and
// gained pixels. uint8; one index for the body, 255 = none.
cv::Mat track_body_index(const IrView& view, Seed seed);

// The SDK's 25 joints in the IR camera's frame, off by about a centimetre; those outside the image are not tracked.
Skeleton track_skeleton(const Body& body, const IrView& view, Seed seed);

}  // namespace dressform
