#pragma once
#include <string>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// A surface of other programs, brought into the form in which its rims and its outer side mean something.
struct MendedMesh {
  TexturedMesh textured;        // every edge has one or two triangles, neighbours turn the same way
  std::vector<int> piece;       // of each triangle: pieces hang together by edges, 0 has the largest area
  std::vector<double> area_m2;  // of each piece, largest first
};

// - Vertices on boundaries that lie within 0.1 mm of one another are joined (seams that were exported apart), except
// where
//   an edge would get more than two triangles; triangles that become none, and doubles, are left out.
// - Where more than two triangles share an edge (a pocket sewn on), two go on into one another - of one piece before
//   those of two, then the flattest pair - and the others become a piece of their own, which keeps its place.
// - Triangles that are turned against their neighbours are turned, and pieces so that they look away from the middle of
//   the largest.
// Corner texture coordinates may be absent. Throws InputError naming `where`, with
// count and place: for a one-sided (Moebius) surface, and for overused edges that cannot be taken apart.
MendedMesh mended(TexturedMesh textured, const std::string& where);

// The triangles of one piece, vertices renumbered.
Mesh piece_of(const MendedMesh& mesh, int piece);

}  // namespace dressform
