#pragma once
#include <Eigen/Core>
#include <vector>

#include "pipeline/texture/color_view.h"

namespace dressform {

// What every view says of every vertex. Rows are vertices, columns views.
struct VertexSamples {
  Eigen::MatrixXf trust;             // 0 where the view does not see the vertex
  Eigen::MatrixXf facing;            // cosine between the normal and the direction to the camera
  std::vector<Eigen::MatrixXf> low;  // per view: vertices x 3, BGR of the low band, sRGB levels
};
VertexSamples sample_vertices(const Mesh& mesh, const std::vector<ColorView>& views, const ViewParams& params);

}  // namespace dressform
