#include "synthetic/geometry/surface_distance.h"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/triangle.h"

namespace dressform {

struct SurfaceDistance::Tree {
  Mesh mesh;
  std::vector<Vector3d> normals;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

namespace {

struct Query {
  const Mesh* mesh;
  Vector3d point;
  double best;
  int triangle;
  Vector3d weights;
};

bool visit_triangle(RTCPointQueryFunctionArguments* args) {
  auto& query = *static_cast<Query*>(args->userPtr);
  const Vector3i& t = query.mesh->triangles[args->primID];
  const Vector3d &a = query.mesh->vertices[t[0]], &b = query.mesh->vertices[t[1]], &c = query.mesh->vertices[t[2]];
  const Vector3d w = closest_barycentric(query.point, a, b, c);
  const double distance = (w[0] * a + w[1] * b + w[2] * c - query.point).norm();
  // Ties go to the lower index, so that the order of the visits does not matter.
  const int index = static_cast<int>(args->primID);
  if (distance > query.best || (distance == query.best && query.triangle >= 0 && index > query.triangle)) return false;
  query.best = distance;
  query.triangle = index;
  query.weights = w;
  args->query->radius = static_cast<float>(distance * (1 + 1e-6) + 1e-7);
  return true;
}

}  // namespace

SurfaceDistance::SurfaceDistance(const Mesh& mesh) : tree_(std::make_unique<Tree>()) {
  tree_->mesh = mesh;
  tree_->normals = vertex_normals(mesh);
  tree_->device = rtcNewDevice(nullptr);
  tree_->scene = rtcNewScene(tree_->device);
  RTCGeometry geometry = rtcNewGeometry(tree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size()));
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int k = 0; k < 3; ++k) vertices[3 * i + k] = static_cast<float>(mesh.vertices[i][k]);
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), mesh.triangles.size()));
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) indices[3 * i + k] = static_cast<unsigned>(mesh.triangles[i][k]);
  rtcSetGeometryPointQueryFunction(geometry, visit_triangle);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(tree_->scene);
}

SurfaceDistance::~SurfaceDistance() {
  rtcReleaseScene(tree_->scene);
  rtcReleaseDevice(tree_->device);
}

SurfaceDistance::Closest SurfaceDistance::closest(const Vector3d& point, double reach_m) const {
  Query query{&tree_->mesh, point, reach_m, -1, {}};
  RTCPointQuery at{static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z()), 0.f,
                   static_cast<float>(reach_m + 1e-6)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(tree_->scene, &at, &context, nullptr, &query);
  Closest result;
  if (query.triangle < 0) return result;
  result.found = true;
  const Vector3i& t = tree_->mesh.triangles[query.triangle];
  result.point.setZero();
  result.normal.setZero();
  for (int k = 0; k < 3; ++k) {
    result.point += query.weights[k] * tree_->mesh.vertices[t[k]];
    result.normal += query.weights[k] * tree_->normals[t[k]];
  }
  result.normal.normalize();
  result.height = (point - result.point).dot(result.normal);
  result.distance = query.best;
  return result;
}

Mesh pushed_clear(const Mesh& cloth, const Mesh& surface, double clearance_m) {
  constexpr double kReach = 0.03;
  constexpr int kRounds = 12;
  const SurfaceDistance tree(surface);
  Mesh result = cloth;
  const size_t count = cloth.vertices.size();
  std::vector<std::vector<int>> neighbours(count);
  for (const Vector3i& t : cloth.triangles)
    for (int k = 0; k < 3; ++k) {
      neighbours[t[k]].push_back(t[(k + 1) % 3]);
      neighbours[t[k]].push_back(t[(k + 2) % 3]);
    }
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Vector3d> push(count, Vector3d::Zero());
    tbb::parallel_for(size_t{0}, count, [&](size_t i) {
      const auto near = tree.closest(result.vertices[i], kReach);
      // Beside the edge of an open surface the closest point says nothing about sides.
      if (!near.found || std::abs(near.height) < 0.7 * near.distance) return;
      if (near.height < clearance_m) push[i] = (1.02 * clearance_m - near.height) * near.normal;
    });
    if (std::none_of(push.begin(), push.end(), [](const Vector3d& p) { return p.squaredNorm() > 0; })) break;
    // Neighbours follow part of the way, except at the end, when only what is too near still moves.
    const std::vector<Vector3d> own = push;
    if (round < kRounds - 4)
      for (size_t i = 0; i < count; ++i) {
        Vector3d mean = Vector3d::Zero();
        for (int n : neighbours[i]) mean += own[n] / static_cast<double>(neighbours[i].size());
        if (own[i].squaredNorm() == 0) push[i] = 0.7 * mean;
      }
    for (size_t i = 0; i < count; ++i) result.vertices[i] += push[i];
  }
  return result;
}

}  // namespace dressform
