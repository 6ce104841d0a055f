#pragma once
#include <memory>
#include <vector>

#include "synthetic/capture/ir_packet.h"
#include "synthetic/capture/surface.h"
#include "synthetic/capture/texture_pyramid.h"

namespace dressform {

// Sixteen rays, e.g. of a 4 x 4 block of pixels. A ray hits between near_t and far_t, in units of its direction's
// length. Lanes that were not set are not traced.
struct RayPacket {
  alignas(64) float origin_x[packet_size], origin_y[packet_size], origin_z[packet_size];
  alignas(64) float direction_x[packet_size], direction_y[packet_size], direction_z[packet_size];
  alignas(64) float near_t[packet_size], far_t[packet_size];
  alignas(64) int valid[packet_size];  // 0 or -1

  struct Unset {};
  RayPacket();                  // no lane is set
  explicit RayPacket(Unset) {}  // everything is still to be written
  void set(int lane, const Vector3f& origin, const Vector3f& direction, float near_t_, float far_t_);
  Vector3f origin(int lane) const { return {origin_x[lane], origin_y[lane], origin_z[lane]}; }
  Vector3f direction(int lane) const { return {direction_x[lane], direction_y[lane], direction_z[lane]}; }
};

struct HitPacket {
  float t[packet_size];      // of the first hit, in units of the direction's length
  int surface[packet_size];  // -1: nothing hit
  int triangle[packet_size];
  float u[packet_size], v[packet_size];  // barycentric weights of the triangle's 2nd and 3rd corner
  Vector3f geometric_normal(int lane) const { return {normal_x[lane], normal_y[lane], normal_z[lane]}; }
  float normal_x[packet_size], normal_y[packet_size], normal_z[packet_size];  // not of unit length
};

struct NormalPacket {
  alignas(64) float x[packet_size], y[packet_size], z[packet_size];
};

// A hit, looked up: normals are of unit length and face the ray's origin.
struct SurfacePoint {
  Vector3f position, normal, geometric_normal;
  Vector3f albedo_rgb;  // linear
  float nir_albedo = 0;
  const Material* material = nullptr;
};

enum class Coherence { coherent, incoherent };

// Surfaces in an Embree scene. Rays are always traced in packets of sixteen (single rays give other last bits).
class RayScene {
 public:
  explicit RayScene(std::vector<RaySurface> surfaces);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  void intersect(const RayPacket& rays, HitPacket& hits, Coherence coherence) const;
  // occluded[lane]: something lies between near_t and far_t.
  void occluded(const RayPacket& rays, bool (&occluded)[packet_size], Coherence coherence) const;

  // footprint_m: width of what the sample stands for, at the hit and across the ray; picks the texture's level.
  SurfacePoint point(const RayPacket& rays, const HitPacket& hits, int lane, float footprint_m) const;

  // Unit normal, interpolated where the surface is smooth, facing the ray's origin.
  Vector3f normal(const RayPacket& rays, const HitPacket& hits, int lane) const;
  // The same for all sixteen at once; zero where nothing is hit.
  void normals(const RayPacket& rays, const HitPacket& hits, NormalPacket& out) const;
  // Albedo at 860 nm; a print shows in it faintly.
  float nir_albedo(const HitPacket& hits, int lane) const;

  const std::vector<RaySurface>& surfaces() const { return surfaces_; }
  const std::vector<Vector3f>& vertex_normals_of(int surface) const { return details_[surface].normals; }

 private:
  struct Details {
    std::vector<Vector3f> normals;  // per vertex
    std::unique_ptr<TexturePyramid> texture;
    std::vector<float> texels_per_m;  // per triangle
  };
  struct Embree;
  void attach(const RaySurface& surface, unsigned id);
  Vector3f albedo(int surface, int triangle, float u, float v, float footprint_m) const;
  std::vector<RaySurface> surfaces_;
  std::vector<Details> details_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace dressform
