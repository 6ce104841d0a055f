#include "eval/metrics/mesh_distance.h"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dressform::metrics {
namespace {

constexpr std::size_t kChunk = 4096;  // points that one task walks along the curve

// Barycentric weights of the point of triangle (a, b, c) nearest to p, by the region of its plane p falls into.
Vector3d nearest_weights(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  if (area > 0) {
    const Vector3d ap = p - a;
    const double v = ap.cross(ac).dot(normal) / area, w = ab.cross(ap).dot(normal) / area;
    if (v >= 0 && w >= 0 && v + w <= 1) return {1 - v - w, v, w};
  }
  // Outside the triangle's prism: the nearest point lies on a side.
  const Vector3d corners[3] = {a, b, c};
  Vector3d best = Vector3d::UnitX();
  double best_distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vector3d &from = corners[k], side = corners[(k + 1) % 3] - from;
    const double length = side.squaredNorm();
    const double along = length > 0 ? std::clamp((p - from).dot(side) / length, 0.0, 1.0) : 0.0;
    const double distance = (from + along * side - p).squaredNorm();
    if (!(distance < best_distance)) continue;
    best_distance = distance;
    best.setZero();
    best[k] = 1 - along;
    best[(k + 1) % 3] += along;
  }
  return best;
}

struct Search {
  const Mesh* mesh;
  Vector3d point;
  NearestOnMesh best;
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<Search*>(arguments->userPtr);
  const int triangle = static_cast<int>(arguments->primID);
  const Vector3i& t = search.mesh->triangles[triangle];
  const auto& v = search.mesh->vertices;
  const Vector3d weights = nearest_weights(search.point, v[t[0]], v[t[1]], v[t[2]]);
  const double distance = (weights[0] * v[t[0]] + weights[1] * v[t[1]] + weights[2] * v[t[2]] - search.point).norm();
  const bool nearer =
      distance < search.best.distance_m || (distance == search.best.distance_m && triangle < search.best.triangle);
  if (!nearer) return false;
  int corner = 0;
  weights.maxCoeff(&corner);
  search.best = {distance, triangle, t[corner], weights};
  arguments->query->radius = static_cast<float>(distance * (1 + 1e-5) + 2e-6);  // boxes are single precision
  return true;
}

std::uint64_t spread(std::uint64_t x) {  // 21 bits, two zeros between
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

std::vector<std::uint32_t> morton_order(const std::vector<Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  const double cell = std::max(box.sizes().maxCoeff(), 1e-9) / 2097151.0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d place = (points[i] - box.min()) / cell;
    keys[i] = {spread(std::uint64_t(place.x())) | spread(std::uint64_t(place.y())) << 1 |
                   spread(std::uint64_t(place.z())) << 2,
               static_cast<std::uint32_t>(i)};
  }
  tbb::parallel_sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].second;
  return order;
}

}  // namespace

struct MeshDistance::Device {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Device() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

MeshDistance::MeshDistance(const Mesh& mesh) : mesh_(mesh), device_(std::make_unique<Device>()) {
  if (mesh.triangles.empty()) throw std::invalid_argument("MeshDistance: a mesh without triangles");
  device_->device = rtcNewDevice("threads=1");
  device_->scene = rtcNewScene(device_->device);
  rtcSetSceneFlags(device_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int k = 0; k < 3; ++k) vertices[3 * i + k] = static_cast<float>(mesh.vertices[i][k]);
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) indices[3 * i + k] = static_cast<unsigned>(mesh.triangles[i][k]);
  rtcSetGeometryPointQueryFunction(geometry, visit);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(device_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(device_->scene);
}

MeshDistance::~MeshDistance() = default;

NearestOnMesh MeshDistance::search(const Vector3d& point, double bound_m) const {
  Search state{&mesh_, point, {std::numeric_limits<double>::infinity(), -1, -1, Vector3d::Zero()}};
  RTCPointQuery query;
  query.x = static_cast<float>(point.x());
  query.y = static_cast<float>(point.y());
  query.z = static_cast<float>(point.z());
  query.time = 0;
  query.radius = static_cast<float>(bound_m * (1 + 1e-5) + 2e-6);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(device_->scene, &query, &context, nullptr, &state);
  return state.best;
}

NearestOnMesh MeshDistance::nearest(const Vector3d& point) const {
  return search(point, std::numeric_limits<float>::max());
}

std::vector<NearestOnMesh> MeshDistance::nearest(const std::vector<Vector3d>& points) const {
  std::vector<NearestOnMesh> result(points.size());
  const auto order = morton_order(points);
  tbb::parallel_for(std::size_t(0), (points.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const Vector3d& point = points[order[i]];
      if (i == chunk * kChunk) {
        result[order[i]] = nearest(point);
        continue;
      }
      const auto& before = result[order[i - 1]];
      const double bound = before.distance_m + (point - points[order[i - 1]]).norm();
      result[order[i]] = search(point, bound + 1e-6);
      if (result[order[i]].triangle < 0) result[order[i]] = nearest(point);
    }
  });
  return result;
}

bool MeshDistance::sees(const Vector3d& eye, const Vector3d& point, double slack_m) const {
  const Vector3d step = point - eye;
  const double length = step.norm();
  if (length <= slack_m) return true;
  RTCRay ray{};
  ray.org_x = static_cast<float>(eye.x());
  ray.org_y = static_cast<float>(eye.y());
  ray.org_z = static_cast<float>(eye.z());
  ray.dir_x = static_cast<float>(step.x() / length);
  ray.dir_y = static_cast<float>(step.y() / length);
  ray.dir_z = static_cast<float>(step.z() / length);
  ray.tnear = 0;
  ray.tfar = static_cast<float>(length - slack_m);
  ray.mask = -1u;  // ray masks are on in Debian's Embree: 0 hits nothing
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(device_->scene, &context, &ray);
  return ray.tfar > 0;
}

Vector3d triangle_normal(const Mesh& mesh, int triangle) {
  const Vector3i& t = mesh.triangles[triangle];
  const auto& v = mesh.vertices;
  const Vector3d normal = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]);
  const double length = normal.norm();
  return length > 0 ? Vector3d(normal / length) : Vector3d::Zero();
}

double winding_number(const Mesh& mesh, const Vector3d& point) {
  double sum = 0;
  for (const Vector3i& t : mesh.triangles) {  // solid angle: van Oosterom and Strackee, 1983
    const Vector3d a = mesh.vertices[t[0]] - point, b = mesh.vertices[t[1]] - point, c = mesh.vertices[t[2]] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * M_PI);
}

}  // namespace dressform::metrics
