#include "pipeline/geometry/submesh.h"

#include <stdexcept>

namespace dressform {

Mesh submesh(const Mesh& mesh, const std::vector<char>& kept) {
  if (kept.size() != mesh.triangles.size()) throw std::invalid_argument("submesh: one flag is needed per triangle");
  Mesh part;
  part.vertices = mesh.vertices;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) part.triangles.push_back(mesh.triangles[i]);
  return compacted(part);
}

}  // namespace dressform
