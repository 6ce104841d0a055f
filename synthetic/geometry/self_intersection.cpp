#include "synthetic/geometry/self_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

namespace dressform {

long self_intersections(const Mesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  Surface surface;
  for (const Vector3d& v : mesh.vertices) surface.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
  for (const Vector3i& t : mesh.triangles) {
    const auto vertex = [&](int k) { return Surface::Vertex_index(static_cast<Surface::size_type>(t[k])); };
    surface.add_face(vertex(0), vertex(1), vertex(2));
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(surface, std::back_inserter(pairs));
  return static_cast<long>(pairs.size());
}

}  // namespace dressform
