#pragma once
#include <vector>

#include "synthetic/capture/ray_scene.h"
#include "synthetic/capture/ray_table.h"

namespace dressform {

// What one ray of an infrared camera meets.
struct IrSample {
  float depth_m = 0;        // along the optical axis; 0: nothing
  float cos_incidence = 0;  // between the normal and the way back to the camera, 0 to 1
  float nir_albedo = 0;
  float distance_m = 0;  // along the ray
  float mirror_cos = 0;  // chrome only: cosine between its mirrored ray and the way back; 1: it blinds
  bool chrome = false;
};

// The world as one infrared camera stands before it: what a sensor model turns into a measured frame.
class IrView {
 public:
  // wants_infrared: false for a scan, of which only the depth is kept; a model may then leave the picture empty.
  IrView(const RayScene& scene, const RayTable& rays, const Camera& camera, const Isometry3d& world_from_sensor,
         double depth_offset_m, bool wants_infrared = true);

  int width() const { return rays_.width(); }
  int height() const { return rays_.height(); }
  const Camera& camera() const { return camera_; }
  const Isometry3d& world_from_sensor() const { return world_from_sensor_; }
  double depth_offset_m() const { return depth_offset_m_; }
  bool wants_infrared() const { return wants_infrared_; }
  const RayScene& scene() const { return scene_; }

  // Ideal image-plane coordinates (x/z, y/z) at a raw pixel position.
  Vector2f ideal(float x, float y) const { return rays_.at(x, y); }

  // One ray through the centre of every pixel, row by row.
  std::vector<IrSample> first_hits() const;

  // Up to sixteen rays at any raw pixel positions at once; positions must lie within one pixel of the image.
  void trace(const Vector2f* pixels, int count, IrSample* samples) const;

  // The same rays, asked only what kind of thing they meet.
  void trace_labels(const Vector2f* pixels, int count, Label* labels) const;

 private:
  void trace_packet(const RayPacket& packet, IrSample (&samples)[packet_size]) const;
  Vector3f direction(const Vector2f& ideal) const;
  const RayScene& scene_;
  const RayTable& rays_;
  Camera camera_;
  Isometry3d world_from_sensor_;
  double depth_offset_m_;
  bool wants_infrared_;
  Eigen::Matrix3f rotation_;
  Vector3f position_;
};

}  // namespace dressform
