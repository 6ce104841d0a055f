#pragma once
#include <array>
#include <vector>

#include "synthetic/garments/clip.h"
#include "synthetic/garments/drape/near_pairs.h"
#include "synthetic/garments/garment.h"

namespace dressform {

// A polo collar as cut: a stand that rises from the neck's rim and a fall turned down over it.
struct CollarCut {
  Level seam;  // zero where the collar is sewn on, negative below: along the edges of a slit in front
  double stand_m = 0.028, fall_m = 0.062;
};

// Cloth with a collar sewn to its rim. The collar's outer side is that of the stand: the fall shows its inner side.
struct CollaredCloth {
  Mesh mesh;                                    // the cloth's vertices and triangles first, as they were
  std::vector<int> row;                         // per vertex, of the collar: 0 on the rim; -1 elsewhere
  int fold_row = 0;                             // the collar is pressed flat along this row and the next
  std::vector<std::array<Vector2d, 3>> places;  // per triangle of the collar, by corner: metres in its own image
                                                // (as ClothPiece::place)
  // Per edge: part of the cloth's stiffness against bending. Nearly none along the seam and the fold, more in the
  // collar, which is of two layers.
  std::vector<double> bending(const Features& features) const;
};

// Sews the collar to the loop `rim` (in the order of boundary_loops), clear of the cloth and of the body. The walk
// along the rim has to go round the neck without turning back. Throws InputError where the collar meets itself, the
// cloth or the body.
CollaredCloth with_collar(const Mesh& cloth, const std::vector<int>& rim, const CollarCut& cut, const Body& body,
                          double edge_m);

}  // namespace dressform
