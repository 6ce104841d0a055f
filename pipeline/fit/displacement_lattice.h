#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// A map of space by displacements at the nodes of a lattice, which pairs of points pull.
class DisplacementLattice {
 public:
  // Between the nodes: cubic B-splines, as in free-form deformation; or linear, as in a mesh of the space.
  enum class Between { cubic, linear };
  struct Box {
    Vector3d low = Vector3d::Zero(), high = Vector3d::Zero();  // metres
  };

  // The displacements that take the controls nearest to the targets, in squares, and bend least: `stiffness` times the
  // squared second differences along the lattice's edges is added. Outside the box the map is what it is at the box's
  // side. No controls: the identity. Throws std::invalid_argument if the lists differ in length or the step is not
  // positive.
  DisplacementLattice(const Box& box, double step_m, Between between, double stiffness,
                      const std::vector<Vector3d>& controls, const std::vector<Vector3d>& targets);

  Vector3d operator()(const Vector3d& point) const;
  int nodes() const { return static_cast<int>(displacements_.size()); }

 private:
  struct Weights {  // of the nodes about a point
    std::vector<int> nodes;
    std::vector<double> weights;
  };
  Weights weights_at(const Vector3d& point) const;
  int node(int x, int y, int z) const { return x + size_[0] * (y + size_[1] * z); }

  Vector3d origin_;
  double step_m_;
  Between between_;
  std::array<int, 3> size_{0, 0, 0};
  std::vector<Vector3d> displacements_;
};

// The box of a body with room about it for the clothes.
DisplacementLattice::Box box_round(const Mesh& body, double margin_m);

}  // namespace dressform
