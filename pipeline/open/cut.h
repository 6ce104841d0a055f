#pragma once
#include <functional>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// What is to be taken off a closed surface at one opening.
struct Cap {
  std::vector<double> beyond;  // per vertex: positive beyond the rim, negative in the garment, a length
  int pole = -1;               // a vertex in the middle of the cap
};

struct CutResult {
  Mesh mesh;                       // open; empty if a cap has no vertex or nothing is left
  std::vector<int> cap_of_vertex;  // of the mesh: the cap on whose rim the vertex lies, -1 for none
};

// Cuts the caps off a closed mesh without handles. A cap is the piece of beyond > 0 that holds its pole, and all that
// it encloses, so that it is a disc; triangles are split where `beyond` is zero. One component with one boundary loop
// for each cap.
CutResult cut_caps(const Mesh& closed, const std::vector<Cap>& caps);

// Collapses the edges shorter than `shortest_m`; the boundary keeps its place. Same topology.
Mesh without_slivers(const Mesh& open, double shortest_m);

}  // namespace dressform
