#pragma once
#include <array>
#include <string>

#include "render/renderer.h"

namespace dressform {

// Two meshes in one frame from the same four sides, each row with its name, and below them the first in the colours of
// its vertices' distance to the second (0 to the 99th percentile, but 1 mm at least), with a colour bar. 8-bit BGR.
cv::Mat compared_meshes(Renderer& renderer, const RenderItem& first, const RenderItem& second,
                        const std::array<std::string, 2>& names, int height_px);

}  // namespace dressform
