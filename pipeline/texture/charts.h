#pragma once
#include <array>
#include <opencv2/core/types.hpp>
#include <vector>

#include "pipeline/texture/color_view.h"
#include "pipeline/texture/labels.h"
#include "pipeline/texture/surface_graph.h"

namespace dressform {

struct AtlasParams {
  double texels_per_pixel = 1;  // of the colour image, along each axis
  int gutter_px = 4;            // between charts and to the edge
  int largest_px = 4096;        // charts are made smaller until they fit
};

// Where every triangle lies in the texture: texels with centres at integers, v down. No two triangles overlap and none
// is mirrored.
struct Atlas {
  cv::Size size;
  std::vector<std::array<Vector2d, 3>> corners;
  int charts = 0;
  double texels_per_pixel = 1;  // after charts were made smaller to fit
};

// Connected triangles of one label are laid out as that view's image shows them, so that a texel is a pixel; what is
// turned away from its view is laid out along the coordinate axis that it faces. Deterministic.
Atlas make_atlas(const Mesh& mesh, const SurfaceGraph& graph, const std::vector<ColorView>& views, const Labels& labels,
                 const AtlasParams& params);

}  // namespace dressform
