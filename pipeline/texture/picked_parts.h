#pragma once
#include <vector>

#include "pipeline/texture/color_view.h"

namespace dressform {

struct PickedPartsParams {
  double narrowest = 0.8;    // of a mean edge: from a border, within which triangles make up its strip at first
  double widest_m = 0.03;    // and at most
  double to_rim_m = 0.05;    // a border that ends this near to the mesh's boundary goes on to it
  double least_part = 0.02;  // of the area: a smaller piece joins its neighbours
};

// Which view colours which triangle (-1: there is no view), by borders that a person picked between the views: ordered,
// open paths on the mesh, model frame. Section 3.5 of the thesis: triangles near the borders are strips, the surface
// falls apart between them, each part goes to the view that it faces, and the strips to the parts they touch. The
// strips widen until no more parts come apart.
std::vector<int> parts_between(const Mesh& mesh, const std::vector<std::vector<Vector3d>>& borders,
                               const std::vector<ColorView>& views, const PickedPartsParams& params);

}  // namespace dressform
