#pragma once
#include <functional>
#include <vector>

#include "pipeline/geometry/path_strip.h"

namespace dressform {

// The kept triangles (flags) round a vertex, in fans of those that share edges at it. A vertex inside the surface has
// one fan that closes on itself, one on its edge has one that does not (section 3.4.2 of the thesis); more than one,
// and the surface is pinched there.
struct Fans {
  std::vector<std::vector<int>> triangles;
  bool closed = false;  // the only fan goes all round
};
std::vector<Fans> vertex_fans(const Mesh& mesh, const TriangleNeighbours& neighbours, const std::vector<char>& kept);

// Without triangles of three boundary vertices, which make an edge ragged, and without pinches, of whose fans the
// largest stays. `main_piece` takes what falls off away, after each round.
std::vector<char> with_single_fans(const Mesh& mesh, const TriangleNeighbours& neighbours, std::vector<char> kept,
                                   const std::function<std::vector<char>(const std::vector<char>&)>& main_piece);

}  // namespace dressform
