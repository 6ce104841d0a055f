#include "pipeline/geometry/mesh_query.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "scenes/triangle.h"

namespace dressform {

struct MeshQuery::Device {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Device() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

constexpr double kCornerWeight = 1e-9;  // a barycentric weight below this is on the opposite side

struct ClosestSearch {
  const Mesh* mesh;
  Vector3d point;
  MeshQuery::Closest best;
};

bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<ClosestSearch*>(arguments->userPtr);
  const int triangle = static_cast<int>(arguments->primID);
  const Vector3i& t = search.mesh->triangles[triangle];
  const auto& v = search.mesh->vertices;
  const Vector3d weights = closest_barycentric(search.point, v[t[0]], v[t[1]], v[t[2]]);
  const Vector3d closest = weights[0] * v[t[0]] + weights[1] * v[t[1]] + weights[2] * v[t[2]];
  const double distance = (closest - search.point).norm();
  // Ties go to the lower index, so that the order in which Embree visits does not matter.
  if (distance < search.best.distance || (distance == search.best.distance && triangle < search.best.triangle)) {
    search.best = {triangle, closest, distance};
    // A little wider than the answer: Embree's bounds are single precision.
    arguments->query->radius = static_cast<float>(distance * (1 + 1e-5) + 1e-6);
    return true;
  }
  return false;
}

double corner_angle(const Vector3d& at, const Vector3d& a, const Vector3d& b) {
  const Vector3d u = a - at, w = b - at;
  return std::atan2(u.cross(w).norm(), u.dot(w));
}

}  // namespace

MeshQuery::MeshQuery(const Mesh& mesh) : mesh_(mesh), device_(std::make_unique<Device>()) {
  const auto& v = mesh_.vertices;
  face_normals_.reserve(mesh_.triangles.size());
  corner_normals_.assign(v.size(), Vector3d::Zero());
  std::map<std::pair<int, int>, Vector3d> edges;
  for (const Vector3i& t : mesh_.triangles) {
    const Vector3d normal = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).stableNormalized();
    face_normals_.push_back(normal.allFinite() ? normal : Vector3d::Zero());
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      corner_normals_[a] += corner_angle(v[a], v[b], v[c]) * face_normals_.back();
      const auto found = edges.emplace(std::minmax(a, b), Vector3d::Zero()).first;
      found->second += face_normals_.back();
    }
  }
  side_normals_.reserve(mesh_.triangles.size());
  for (const Vector3i& t : mesh_.triangles) {
    std::array<Vector3d, 3> sides;
    for (int k = 0; k < 3; ++k) sides[k] = edges.at(std::minmax(t[(k + 1) % 3], t[(k + 2) % 3]));
    side_normals_.push_back(sides);
  }
  if (mesh_.triangles.empty()) return;

  device_->device = rtcNewDevice("threads=1");
  device_->scene = rtcNewScene(device_->device);
  rtcSetSceneFlags(device_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), v.size()));
  for (std::size_t i = 0; i < v.size(); ++i)
    for (int k = 0; k < 3; ++k) vertices[3 * i + k] = static_cast<float>(v[i][k]);
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), mesh_.triangles.size()));
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) indices[3 * i + k] = static_cast<unsigned>(mesh_.triangles[i][k]);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(device_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(device_->scene);
}

MeshQuery::~MeshQuery() = default;
MeshQuery::MeshQuery(MeshQuery&&) noexcept = default;
MeshQuery& MeshQuery::operator=(MeshQuery&&) noexcept = default;

MeshQuery::Closest MeshQuery::closest(const Vector3d& point, double max_distance) const {
  ClosestSearch search{&mesh_, point, {}};
  if (!device_->scene || !point.allFinite()) return search.best;
  search.best.distance = max_distance;
  RTCPointQuery query;
  query.x = static_cast<float>(point.x());
  query.y = static_cast<float>(point.y());
  query.z = static_cast<float>(point.z());
  query.time = 0;
  query.radius = std::isfinite(max_distance) ? static_cast<float>(max_distance * (1 + 1e-5) + 1e-6)
                                             : std::numeric_limits<float>::infinity();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(device_->scene, &query, &context, visit_triangle, &search);
  if (search.best.triangle < 0) search.best.distance = std::numeric_limits<double>::infinity();
  return search.best;
}

Vector3d MeshQuery::pseudonormal(const Closest& closest) const {
  const Vector3i& t = mesh_.triangles[closest.triangle];
  const auto& v = mesh_.vertices;
  const Vector3d weights = closest_barycentric(closest.point, v[t[0]], v[t[1]], v[t[2]]);
  int zero = 0, side = 0, corner = 0;
  for (int k = 0; k < 3; ++k) {
    if (weights[k] < kCornerWeight) {
      ++zero;
      side = k;
    } else {
      corner = k;
    }
  }
  if (zero >= 2) return corner_normals_[t[corner]];
  if (zero == 1) return side_normals_[closest.triangle][side];
  return face_normals_[closest.triangle];
}

double MeshQuery::signed_distance(const Vector3d& point, const Closest& closest) const {
  if (closest.triangle < 0) return std::numeric_limits<double>::infinity();
  return (point - closest.point).dot(pseudonormal(closest)) < 0 ? -closest.distance : closest.distance;
}

double MeshQuery::signed_distance(const Vector3d& point) const { return signed_distance(point, closest(point)); }

std::optional<MeshQuery::Hit> MeshQuery::first_hit(const Vector3d& origin, const Vector3d& direction,
                                                   double near) const {
  if (!device_->scene) return {};
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(origin.x());
  ray.ray.org_y = static_cast<float>(origin.y());
  ray.ray.org_z = static_cast<float>(origin.z());
  ray.ray.dir_x = static_cast<float>(direction.x());
  ray.ray.dir_y = static_cast<float>(direction.y());
  ray.ray.dir_z = static_cast<float>(direction.z());
  ray.ray.tnear = static_cast<float>(near);
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = -1;  // Debian's Embree has ray masks switched on
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(device_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return Hit{static_cast<int>(ray.hit.primID), ray.ray.tfar, origin + static_cast<double>(ray.ray.tfar) * direction};
}

}  // namespace dressform
