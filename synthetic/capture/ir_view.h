#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstdint>
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

// A packet's hits, picked apart.
void unpack(const IrPacket& packet, IrSample (&samples)[packet_size]);

// The world as one infrared camera stands before it: what a sensor model turns into a measured frame.
class IrView {
 public:
  // wants_infrared: false for a scan, of which only the depth is kept; a model may then leave the image empty.
  // device: a number for the piece of hardware, the same in all its shots; what makes it differ from its like hangs on
  // it.
  IrView(const RayScene& scene, const RayTable& rays, const Camera& camera, const Isometry3d& world_from_sensor,
         double depth_offset_m, bool wants_infrared = true, std::uint64_t device = 0);

  int width() const { return rays_.width(); }
  int height() const { return rays_.height(); }
  const Camera& camera() const { return camera_; }
  const Isometry3d& world_from_sensor() const { return world_from_sensor_; }
  double depth_offset_m() const { return depth_offset_m_; }
  bool wants_infrared() const { return wants_infrared_; }
  std::uint64_t device() const { return device_; }
  const RayScene& scene() const { return scene_; }

  // Ideal image-plane coordinates (x/z, y/z) at a raw pixel position.
  Vector2f ideal(float x, float y) const { return rays_.at(x, y); }
  const Vector2f& ideal(int x, int y) const { return rays_.at(x, y); }

  // One ray through the centre of every pixel, row by row.
  std::vector<IrSample> first_hits() const;

  // The same, in packets of 4 x 4 pixels: body(left, top, packet), in parallel, in any order. Lanes beyond the image's
  // edge have met nothing.
  static constexpr int block = 4;
  template <class Body>
  void for_each_block(const Body& body) const {
    const int columns = (width() + block - 1) / block, rows = (height() + block - 1) / block;
    tbb::parallel_for(tbb::blocked_range<int>(0, rows, 2), [&](const tbb::blocked_range<int>& range) {
      for (int row = range.begin(); row < range.end(); ++row)
        for (int column = 0; column < columns; ++column) {
          IrPacket packet;
          trace_block(column * block, row * block, packet);
          body(column * block, row * block, packet);
        }
    });
  }

  // Up to sixteen rays at any raw pixel positions at once; positions must lie within one pixel of the image.
  void trace(const Vector2f* pixels, int count, IrSample* samples) const;
  void trace(const Vector2f* pixels, int count, IrPacket& packet) const;

  // The same rays, asked only what kind of thing they meet.
  void trace_labels(const Vector2f* pixels, int count, Label* labels) const;

 private:
  void trace_block(int left, int top, IrPacket& packet) const;
  void aim(int count, const IrPacket& packet, RayPacket& rays) const;
  void look_up(const RayPacket& rays, IrPacket& packet) const;
  Vector3f direction(const Vector2f& ideal) const;
  const RayScene& scene_;
  const RayTable& rays_;
  Camera camera_;
  Isometry3d world_from_sensor_;
  double depth_offset_m_;
  bool wants_infrared_;
  std::uint64_t device_;
  Eigen::Matrix3f rotation_;
  Vector3f position_;
};

}  // namespace dressform
