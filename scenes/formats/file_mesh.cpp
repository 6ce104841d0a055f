#include "scenes/formats/file_mesh.h"

#include <stdexcept>

namespace dressform {
namespace {

// A list of one value a triangle, or an empty one.
template <class Value>
void keep(const std::vector<char>& kept, std::vector<Value>& values) {
  if (values.empty()) return;
  std::size_t to = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) values[to++] = values[i];
  values.resize(to);
}

}  // namespace

void keep_triangles(const std::vector<char>& kept, FileMesh& file) {
  if (kept.size() != file.mesh.triangles.size())
    throw std::invalid_argument("keep_triangles: one flag is needed per triangle");
  keep(kept, file.mesh.triangles);
  keep(kept, file.corner_uv);
  keep(kept, file.corner_color);
  keep(kept, file.material);
}

}  // namespace dressform
