#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Generalized winding number of a triangle mesh that need not be closed, manifold or one piece (Jacobson, Kavan and
// Sorkine-Hornung, SIGGRAPH 2013): 1 inside a closed outward mesh, 0 outside, in between where it is open. Triangles
// far away count together, as the dipole of their areas (Barill et al., ACM TOG 2018): within 0.02. Safe to ask from
// several threads; the answers do not depend on their number.
class WindingNumber {
 public:
  explicit WindingNumber(const Mesh& mesh);  // keeps what it needs

  double operator()(const Vector3d& point) const;  // 0 for an empty mesh

 private:
  struct Node {
    Vector3d area = Vector3d::Zero();    // sum of the triangles' normals times their areas, m^2
    Vector3d centre = Vector3d::Zero();  // of the areas
    double radius_m = 0;                 // of the ball about the centre that holds all corners
    int first = 0, last = 0;             // triangles, in the tree's order
    int left = -1, right = -1;           // children; -1: a leaf
  };
  struct Triangle {
    Vector3d a, b, c;
  };
  int build(int first, int last);
  double of_node(int node, const Vector3d& point) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace dressform
