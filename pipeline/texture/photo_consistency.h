#pragma once
#include <vector>

#include "pipeline/texture/vertex_samples.h"

namespace dressform {

struct PhotoConsistencyParams {
  int rounds = 50;            // of averaging colours and moving views
  double least_facing = 0.3;  // vertices seen at a lower cosine do not count
};

// Root mean square difference (levels of luma) of what the views see at the vertices that more than one sees, from the
// views' mean there; 0 where there are none.
double color_spread(const Mesh& mesh, const std::vector<ColorView>& views, const VertexSamples& samples,
                    const PhotoConsistencyParams& params);

// The views moved, each by a rigid motion of its camera, until what they see at the vertices agrees: in turns the mean
// luma of every vertex, and a step of Levenberg and Marquardt for every view against the means (Zhou and Koltun, "Color
// map optimization for 3D reconstruction with consumer depth cameras", ACM TOG 2014, the rigid form). A view moves only
// where that lowers its difference; one that shares no vertex stays. Same order of sums whatever the threads.
std::vector<ColorView> photo_consistent(const Mesh& mesh, std::vector<ColorView> views, const VertexSamples& samples,
                                        const PhotoConsistencyParams& params);

}  // namespace dressform
