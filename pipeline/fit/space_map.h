#pragma once
#include <functional>
#include <utility>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// A map of space, whatever it is made of: metres, from the naked body's space to the user's. Safe to ask from several
// threads.
class SpaceMap {
 public:
  using Function = std::function<Vector3d(const Vector3d&)>;

  SpaceMap() = default;  // leaves everything in place
  explicit SpaceMap(Function function) : function_(std::move(function)) {}

  Vector3d operator()(const Vector3d& point) const { return function_ ? function_(point) : point; }
  std::vector<Vector3d> operator()(const std::vector<Vector3d>& points) const;  // on all threads

 private:
  Function function_;
};

// Makes a map that takes controls to targets, as nearly as it can.
using MakeMap = std::function<SpaceMap(const std::vector<Vector3d>& controls, const std::vector<Vector3d>& targets)>;

}  // namespace dressform
