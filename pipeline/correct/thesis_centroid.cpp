// The thesis's correction (section 3.6): the nearest centroid of the body's faces says by its normal whether a vertex
// of cloth is inside. Its text pushes along the vector from the centroid to the vertex, which leads deeper; here the
// vertex goes out along the normal, to the wanted distance from the face's plane.
#include "pipeline/correct/correct_result.h"
#include "pipeline/geometry/point_tree.h"

namespace dressform {
namespace {

struct ThesisCentroidParams {
  double gap_m = 0.003;
};
template <class V>
void fields(V& v, ThesisCentroidParams& p) {
  v("gap_m", p.gap_m, 0.0, 0.02, "m", "distance from the face's plane to which vertices inside are pushed");
}

struct Faces {
  std::vector<Vector3d> centroids, normals;

  explicit Faces(const Mesh& mesh) {
    for (const auto& t : mesh.triangles) {
      const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      const Vector3d normal = (b - a).cross(c - a);
      if (normal.norm() <= 0) continue;
      centroids.push_back((a + b + c) / 3);
      normals.push_back(normal.normalized());
    }
  }
};

CorrectedGarments thesis_centroid(const KnownBody& user, const FittedGarments& fitted,
                                  const ThesisCentroidParams& params) {
  require_user(user, "correct.thesis_centroid");
  const Faces faces(user.body);
  const PointTree tree(faces.centroids);
  return each_vertex_moved(user, fitted, [&](const Vector3d& p) -> Vector3d {
    std::uint32_t nearest = 0;
    double squared_distance = 0;
    if (!tree.nearest(p, nearest, squared_distance)) return p;
    const double height = faces.normals[nearest].dot(p - faces.centroids[nearest]);
    return height < 0 ? Vector3d(p + (params.gap_m - height) * faces.normals[nearest]) : p;
  });
}

const Correct::Variant thesis_centroid_variant{"thesis_centroid", thesis_centroid};

}  // namespace
}  // namespace dressform
