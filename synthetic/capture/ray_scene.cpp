#include "synthetic/capture/ray_scene.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "scenes/error.h"

namespace dressform {
namespace {

RTCIntersectContext context_for(Coherence coherence) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

void fill(const RayPacket& rays, RTCRay16& out) {
  std::memcpy(out.org_x, rays.origin_x, sizeof out.org_x);
  std::memcpy(out.org_y, rays.origin_y, sizeof out.org_y);
  std::memcpy(out.org_z, rays.origin_z, sizeof out.org_z);
  std::memcpy(out.dir_x, rays.direction_x, sizeof out.dir_x);
  std::memcpy(out.dir_y, rays.direction_y, sizeof out.dir_y);
  std::memcpy(out.dir_z, rays.direction_z, sizeof out.dir_z);
  std::memcpy(out.tnear, rays.near_t, sizeof out.tnear);
  std::memcpy(out.tfar, rays.far_t, sizeof out.tfar);
  for (int i = 0; i < packet_size; ++i) {
    out.time[i] = 0;
    out.mask[i] = ~0u;  // Debian's Embree is built with ray masks on: an unset mask hits nothing
    out.id[i] = i;
    out.flags[i] = 0;
  }
}

std::vector<Vector3f> float_normals(const Mesh& mesh) {
  std::vector<Vector3f> result;
  for (const auto& normal : vertex_normals(mesh)) result.push_back(normal.cast<float>());
  return result;
}

// Texels along one metre of cloth: the square root of the ratio of areas.
std::vector<float> texel_densities(const RaySurface& surface) {
  std::vector<float> result(surface.mesh.triangles.size(), 0.0f);
  const float texels = static_cast<float>(surface.texture.cols) * surface.texture.rows;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto& uv = surface.corner_uv[i];
    const auto& triangle = surface.mesh.triangles[i];
    const Vector3d& a = surface.mesh.vertices[triangle[0]];
    const double area_m2 =
        (surface.mesh.vertices[triangle[1]] - a).cross(surface.mesh.vertices[triangle[2]] - a).norm();
    const Vector2f e1 = uv[1] - uv[0], e2 = uv[2] - uv[0];
    const float area_uv = std::abs(e1.x() * e2.y() - e1.y() * e2.x());
    if (area_m2 > 0) result[i] = static_cast<float>(std::sqrt(area_uv * texels / area_m2));
  }
  return result;
}

}  // namespace

RayPacket::RayPacket() { std::memset(this, 0, sizeof *this); }

void RayPacket::set(int lane, const Vector3f& origin, const Vector3f& direction, float near_t_, float far_t_) {
  origin_x[lane] = origin.x(), origin_y[lane] = origin.y(), origin_z[lane] = origin.z();
  direction_x[lane] = direction.x(), direction_y[lane] = direction.y(), direction_z[lane] = direction.z();
  near_t[lane] = near_t_, far_t[lane] = far_t_;
  valid[lane] = -1;
}

struct RayScene::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Embree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

RayScene::RayScene(std::vector<RaySurface> surfaces)
    : surfaces_(std::move(surfaces)), details_(surfaces_.size()), embree_(std::make_unique<Embree>()) {
  embree_->device = rtcNewDevice(nullptr);
  if (!embree_->device) throw std::runtime_error("Embree: no device");
  embree_->scene = rtcNewScene(embree_->device);
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips through between two triangles
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const RaySurface& surface = surfaces_[i];
    attach(surface, static_cast<unsigned>(i));
    details_[i].normals = float_normals(surface.mesh);
    if (surface.texture.empty() || surface.corner_uv.size() != surface.mesh.triangles.size()) continue;
    details_[i].texture = std::make_unique<TexturePyramid>(surface.texture);
    details_[i].texels_per_m = texel_densities(surface);
  }
  rtcCommitScene(embree_->scene);
  if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE) throw std::runtime_error("Embree: the scene was not built");
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::attach(const RaySurface& surface, unsigned id) {
  const Mesh& mesh = surface.mesh;
  const RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int c = 0; c < 3; ++c) vertices[3 * i + c] = static_cast<float>(mesh.vertices[i][c]);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const int index = mesh.triangles[i][c];
      if (index < 0 || index >= static_cast<int>(mesh.vertices.size()))
        throw InputError(surface.name, "a triangle names a vertex that is not there");
      indices[3 * i + c] = static_cast<unsigned>(index);
    }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree_->scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

void RayScene::intersect(const RayPacket& rays, HitPacket& hits, Coherence coherence) const {
  RTCRayHit16 query;
  fill(rays, query.ray);
  std::memset(query.hit.geomID, 0xff, sizeof query.hit.geomID);
  std::memset(query.hit.instID, 0xff, sizeof query.hit.instID);
  RTCIntersectContext context = context_for(coherence);
  rtcIntersect16(rays.valid, embree_->scene, &context, &query);
  std::memcpy(hits.t, query.ray.tfar, sizeof hits.t);
  std::memcpy(hits.triangle, query.hit.primID, sizeof hits.triangle);
  std::memcpy(hits.u, query.hit.u, sizeof hits.u);
  std::memcpy(hits.v, query.hit.v, sizeof hits.v);
  std::memcpy(hits.normal_x, query.hit.Ng_x, sizeof hits.normal_x);
  std::memcpy(hits.normal_y, query.hit.Ng_y, sizeof hits.normal_y);
  std::memcpy(hits.normal_z, query.hit.Ng_z, sizeof hits.normal_z);
  for (int i = 0; i < packet_size; ++i) {
    const bool hit = rays.valid[i] && query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    hits.surface[i] = hit ? static_cast<int>(query.hit.geomID[i]) : -1;
  }
}

void RayScene::occluded(const RayPacket& rays, bool (&occluded)[packet_size], Coherence coherence) const {
  RTCRay16 query;
  fill(rays, query);
  RTCIntersectContext context = context_for(coherence);
  rtcOccluded16(rays.valid, embree_->scene, &context, &query);
  for (int i = 0; i < packet_size; ++i)
    occluded[i] = rays.valid[i] && query.tfar[i] == -std::numeric_limits<float>::infinity();
}

Vector3f RayScene::normal(const RayPacket& rays, const HitPacket& hits, int lane) const {
  const Vector3f direction = rays.direction(lane);
  Vector3f geometric = hits.geometric_normal(lane);
  const RaySurface& surface = surfaces_[hits.surface[lane]];
  if (!surface.smooth) {
    geometric.normalize();
    return geometric.dot(direction) > 0 ? Vector3f(-geometric) : geometric;
  }
  const auto& normals = details_[hits.surface[lane]].normals;
  const Vector3i& triangle = surface.mesh.triangles[hits.triangle[lane]];
  const float u = hits.u[lane], v = hits.v[lane];
  Vector3f normal = (1 - u - v) * normals[triangle[0]] + u * normals[triangle[1]] + v * normals[triangle[2]];
  const float length = normal.norm();
  normal = length > 1e-6f ? Vector3f(normal / length) : geometric.normalized();
  // The side is the facet's: an interpolated normal may tip over at a silhouette.
  if (normal.dot(geometric) < 0) geometric = -geometric;
  return geometric.dot(direction) > 0 ? Vector3f(-normal) : normal;
}

void RayScene::normals(const RayPacket& rays, const HitPacket& hits, NormalPacket& out) const {
  for (int lane = 0; lane < packet_size; ++lane) {
    const int id = hits.surface[lane];
    Vector3f normal = id >= 0 ? hits.geometric_normal(lane) : Vector3f::Zero();
    if (id >= 0 && surfaces_[id].smooth) {
      const auto& normals = details_[id].normals;
      const Vector3i& triangle = surfaces_[id].mesh.triangles[hits.triangle[lane]];
      const float u = hits.u[lane], v = hits.v[lane];
      normal = (1 - u - v) * normals[triangle[0]] + u * normals[triangle[1]] + v * normals[triangle[2]];
    }
    out.x[lane] = normal.x(), out.y[lane] = normal.y(), out.z[lane] = normal.z();
  }
  for (int lane = 0; lane < packet_size; ++lane) {
    const float gx = hits.normal_x[lane], gy = hits.normal_y[lane], gz = hits.normal_z[lane];
    const float x = out.x[lane], y = out.y[lane], z = out.z[lane];
    const float length = std::sqrt(x * x + y * y + z * z);
    // The side is the facet's: an interpolated normal may tip over at a silhouette.
    const float facet_side = x * gx + y * gy + z * gz < 0 ? -1.0f : 1.0f;
    const float away = gx * rays.direction_x[lane] + gy * rays.direction_y[lane] + gz * rays.direction_z[lane];
    const float scale = (away * facet_side > 0 ? -1.0f : 1.0f) / (length > 1e-20f ? length : 1.0f);
    out.x[lane] = scale * x, out.y[lane] = scale * y, out.z[lane] = scale * z;
  }
}

Vector3f RayScene::albedo(int surface, int triangle, float u, float v, float footprint_m) const {
  const Details& details = details_[surface];
  const Vector3f& plain = surfaces_[surface].material.albedo_rgb;
  if (!details.texture) return plain;
  const auto& corners = surfaces_[surface].corner_uv[triangle];
  const Vector2f uv = (1 - u - v) * corners[0] + u * corners[1] + v * corners[2];
  return plain.cwiseProduct(details.texture->sample(uv, footprint_m * details.texels_per_m[triangle]));
}

float RayScene::nir_albedo(const HitPacket& hits, int lane) const {
  const int surface = hits.surface[lane];
  const Material& material = surfaces_[surface].material;
  if (!details_[surface].texture || material.nir_print == 0) return material.nir_albedo;
  const float luminance =
      albedo(surface, hits.triangle[lane], hits.u[lane], hits.v[lane], 0.006f).dot(Vector3f(0.21f, 0.72f, 0.07f));
  return material.nir_albedo * (1 + material.nir_print * (luminance - 0.5f));
}

SurfacePoint RayScene::point(const RayPacket& rays, const HitPacket& hits, int lane, float footprint_m) const {
  SurfacePoint result;
  const Vector3f direction = rays.direction(lane);
  result.position = rays.origin(lane) + hits.t[lane] * direction;
  result.geometric_normal = hits.geometric_normal(lane).normalized();
  if (result.geometric_normal.dot(direction) > 0) result.geometric_normal = -result.geometric_normal;
  result.normal = normal(rays, hits, lane);
  result.material = &surfaces_[hits.surface[lane]].material;
  result.albedo_rgb = albedo(hits.surface[lane], hits.triangle[lane], hits.u[lane], hits.v[lane], footprint_m);
  result.nir_albedo = result.material->nir_albedo;
  return result;
}

}  // namespace dressform
