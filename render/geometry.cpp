#include "render/geometry.h"

#include <cmath>
#include <stdexcept>

namespace dressform {
namespace {

std::vector<Vector3d> smooth_normals(const Mesh& mesh) {
  std::vector<Vector3d> normals(mesh.vertices.size(), Vector3d::Zero());
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d area = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    if (!area.allFinite()) continue;
    for (int k = 0; k < 3; ++k) normals[t[k]] += area;
  }
  for (Vector3d& n : normals) n = n.norm() > 0 ? n.normalized() : Vector3d::UnitY();
  return normals;
}

bool has_texture_coordinates(Shading shading) { return shading == Shading::textured || shading == Shading::unlit; }

// Splits the vertices of a mesh whose corners carry different extras.
class Splitter {
 public:
  Splitter(const Mesh& mesh, const Vector3d& origin)
      : mesh_(mesh), origin_(origin), normals_(smooth_normals(mesh)), first_(mesh.vertices.size(), -1) {
    data_.vertices.reserve(mesh.vertices.size() + mesh.vertices.size() / 4);
    data_.indices.reserve(mesh.triangles.size() * 3);
  }

  void corner(int vertex, const Eigen::Vector3f& extra) {
    int found = first_[vertex];
    while (found >= 0 && data_.vertices[found].extra != extra) found = next_[found];
    if (found < 0) {
      found = static_cast<int>(data_.vertices.size());
      data_.vertices.push_back(
          {(mesh_.vertices[vertex] - origin_).cast<float>(), normals_[vertex].cast<float>(), extra});
      next_.push_back(first_[vertex]);
      first_[vertex] = found;
    }
    data_.indices.push_back(static_cast<std::uint32_t>(found));
  }

  DrawData take() { return std::move(data_); }

 private:
  const Mesh& mesh_;
  const Vector3d origin_;
  const std::vector<Vector3d> normals_;
  std::vector<int> first_, next_;  // chains of the vertices made of one vertex
  DrawData data_;
};

Eigen::Vector3f scalar_extra(const RenderItem& item, int index) {
  const double value = item.scalars[index];
  const double span = item.scalar_maximum - item.scalar_minimum;
  if (!std::isfinite(value)) return {0, 0, 0};
  return {static_cast<float>(span > 0 ? (value - item.scalar_minimum) / span : 0), 1, 0};
}

DrawData mesh_data(const RenderItem& item, const Mesh& mesh, const Vector3d& origin) {
  for (const Vector3i& t : mesh.triangles)
    if (t.minCoeff() < 0 || t.maxCoeff() >= static_cast<int>(mesh.vertices.size()))
      throw std::invalid_argument("render: a triangle names a vertex that does not exist");
  Splitter splitter(mesh, origin);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    if (!mesh.vertices[t[0]].allFinite() || !mesh.vertices[t[1]].allFinite() || !mesh.vertices[t[2]].allFinite())
      continue;
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3f extra = Eigen::Vector3f::Zero();
      if (has_texture_coordinates(item.shading)) extra.head<2>() = item.textured->corner_uv[i][k];
      if (item.shading == Shading::scalar) extra = scalar_extra(item, t[k]);
      if (item.shading == Shading::wireframe) extra = Eigen::Vector3f::Unit(k);
      splitter.corner(t[k], extra);
    }
  }
  return splitter.take();
}

DrawData point_data(const RenderItem& item, const Vector3d& origin) {
  const PointCloud& cloud = *item.points;
  DrawData data;
  data.vertices.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!cloud.points[i].allFinite()) continue;
    DrawVertex vertex;
    vertex.position = (cloud.points[i] - origin).cast<float>();
    vertex.normal = cloud.normals.empty() ? Eigen::Vector3f::Zero() : Eigen::Vector3f(cloud.normals[i].cast<float>());
    vertex.extra = cloud.colors.empty() ? item.color : cloud.colors[i];
    if (item.shading == Shading::scalar) vertex.extra = scalar_extra(item, static_cast<int>(i));
    data.vertices.push_back(vertex);
  }
  return data;
}

}  // namespace

const Mesh* mesh_of(const RenderItem& item) { return item.textured ? &item.textured->mesh : item.mesh; }

void check_item(const RenderItem& item) {
  const Mesh* mesh = mesh_of(item);
  const auto fail = [](const char* what) { throw std::invalid_argument(std::string("render: ") + what); };
  if (!!item.mesh + !!item.textured + !!item.points != 1) fail("an item needs one of mesh, textured and points");
  if (item.points && item.shading != Shading::points && item.shading != Shading::scalar)
    fail("points are drawn as points or scalar");
  if (mesh && item.shading == Shading::points) fail("a mesh cannot be drawn as points");
  if (has_texture_coordinates(item.shading)) {
    if (!item.textured || item.textured->texture.type() != CV_8UC3 || item.textured->texture.empty())
      fail("textured and unlit need a textured mesh with an 8-bit BGR texture");
    if (item.textured->corner_uv.size() != mesh->triangles.size()) fail("one corner_uv a triangle is needed");
  }
  const std::size_t count = mesh ? mesh->vertices.size() : item.points->points.size();
  if (item.shading == Shading::scalar && item.scalars.size() != count) fail("one scalar a vertex or point is needed");
  if (item.points && ((!item.points->normals.empty() && item.points->normals.size() != count) ||
                      (!item.points->colors.empty() && item.points->colors.size() != count)))
    fail("one normal and one colour a point are needed, or none");
}

DrawData draw_data(const RenderItem& item, const Vector3d& origin) {
  return item.points ? point_data(item, origin) : mesh_data(item, *mesh_of(item), origin);
}

Eigen::AlignedBox3d bounding_box(const std::vector<RenderItem>& items) {
  Eigen::AlignedBox3d box;
  for (const RenderItem& item : items) {
    const Mesh* mesh = mesh_of(item);
    for (const Vector3d& point : mesh ? mesh->vertices : item.points->points)
      if (point.allFinite()) box.extend(point);
  }
  return box;
}

}  // namespace dressform
