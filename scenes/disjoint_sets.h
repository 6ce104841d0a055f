#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace dressform {

// Sets of 0 to size - 1, each element at first by itself. The root of a set is its least element.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

 private:
  std::vector<int> parent_;
};

}  // namespace dressform
