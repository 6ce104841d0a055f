#include "pipeline/open/flaw.h"

namespace dressform {

std::string flaw_of(const Mesh& mesh, int openings) {
  const Topology t = topology(mesh);
  if (t.components != 1) return "the cut left " + std::to_string(t.components) + " pieces; expected one";
  if (t.loops != openings)
    return "the cut left " + std::to_string(t.loops) + " rims; expected " + std::to_string(openings);
  if (t.non_manifold_edges) return "the cut left edges with more than two triangles";
  if (t.euler() != 2 - openings) return "the closed surface has handles";
  return {};
}

}  // namespace dressform
