#pragma once
#include <string>
#include <vector>

#include "pipeline/surface/surface.h"

namespace dressform {

struct PickedRim {
  std::string name;  // "neck"
  std::vector<Vector3d> points;
};

struct PickedCutParams {
  double color_m = 0.015;    // farthest point of the cloud that gives a triangle its rough colour
  double narrowest = 0.8;    // of a mean edge: from a path, within which triangles are deleted at first
  double widest_m = 0.03;    // and at most, where that does not part the surface
  double farthest_m = 0.08;  // a picked point further off the surface does not belong to it
};

// A closed garment less what lies beyond its rims.
struct PickedCut {
  Mesh mesh;                                 // vertices as in the closed mesh; empty where it could not be cut
  std::vector<std::vector<int>> boundaries;  // for each rim, in their order: its loop, surface to the left
  std::string why;                           // of an empty mesh
};

// Section 3.4.2 of the thesis, up to the sorted boundaries. Triangles whose centroids are near a rim's path are
// deleted; what stays connected and has most of the cloud's colour is the garment. The path's segments are shorter than
// the mesh's edges and lie on the surface, and the distance grows until the surface falls apart with a piece beyond the
// rim that can close it. Triangles of three boundary vertices are deleted as the thesis did by hand, and vertices with
// more than one fan of triangles lose all but the largest.
PickedCut cut_along(const ClosedGarment& closed, const std::vector<PickedRim>& rims, const PickedCutParams& params);

}  // namespace dressform
