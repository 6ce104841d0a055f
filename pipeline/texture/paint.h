#pragma once
#include "pipeline/texture/charts.h"

namespace dressform {

// How much each view counts at each vertex (vertices x views), for coarse and fine detail.
struct BlendWeights {
  Eigen::MatrixXf low, high;
};

struct Painted {
  cv::Mat texture;         // 8-bit BGR, the atlas's size, gutters and gaps filled in
  double unseen_part = 0;  // of the area
};

// Colours every texel: the coarse band of the views blended widely and the fine band narrowly (Burt and Adelson, ACM
// Trans. Graphics 1983; Baumberg, BMVC 2002). Where no view can see, the colour comes along the surface.
// `unlit`: factors in linear light (vertices x 3, BGR) that take the light off; none when empty.
Painted paint(const Mesh& mesh, const SurfaceGraph& graph, const std::vector<ColorView>& views,
              const VertexSamples& samples, const Atlas& atlas, const BlendWeights& weights,
              const Eigen::MatrixXf& unlit, const ViewParams& params);

// A texture of colours known at the vertices (vertices x 3, BGR levels), linear over every triangle; gutters and gaps
// as of paint.
cv::Mat paint_vertex_colors(const Mesh& mesh, const Atlas& atlas, const Eigen::MatrixXf& colors);

// Texture coordinates (0 to 1) of the corners of an atlas.
std::vector<std::array<Vector2f, 3>> texture_coordinates(const Atlas& atlas);

}  // namespace dressform
