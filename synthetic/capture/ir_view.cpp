#include "synthetic/capture/ir_view.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr float near_m = 0.2f, far_m = 30.0f;

}  // namespace

void unpack(const IrPacket& packet, IrSample (&samples)[packet_size]) {
  for (int lane = 0; lane < packet_size; ++lane) {
    IrSample& sample = samples[lane];
    sample = {};
    if (packet.depth_m[lane] <= 0) continue;
    const float x = packet.ideal_x[lane], y = packet.ideal_y[lane];
    const float length = std::sqrt(1 + x * x + y * y);
    sample.depth_m = packet.depth_m[lane];
    sample.distance_m = packet.depth_m[lane] * length;
    const float along = packet.normal_x[lane] * x + packet.normal_y[lane] * y + packet.normal_z[lane];
    sample.cos_incidence = std::clamp(-along / length, 0.0f, 1.0f);
    sample.nir_albedo = packet.nir_albedo[lane];
    sample.chrome = packet.chrome[lane] != 0;
    if (sample.chrome) sample.mirror_cos = 2 * sample.cos_incidence * sample.cos_incidence - 1;
  }
}

IrView::IrView(const RayScene& scene, const RayTable& rays, const Camera& camera, const Isometry3d& world_from_sensor,
               double depth_offset_m, bool wants_infrared, std::uint64_t device)
    : scene_(scene),
      rays_(rays),
      camera_(camera),
      world_from_sensor_(world_from_sensor),
      depth_offset_m_(depth_offset_m),
      wants_infrared_(wants_infrared),
      device_(device),
      rotation_(world_from_sensor.linear().cast<float>()),
      position_(world_from_sensor.translation().cast<float>()) {}

Vector3f IrView::direction(const Vector2f& ideal) const { return rotation_ * Vector3f(ideal.x(), ideal.y(), 1.0f); }

// Traces the rays and fills in all but the packet's ideal coordinates.
void IrView::look_up(const RayPacket& rays, IrPacket& packet) const {
  HitPacket hits;
  scene_.intersect(rays, hits, Coherence::coherent);
  NormalPacket normals;
  scene_.normals(rays, hits, normals);
  for (int lane = 0; lane < packet_size; ++lane) {
    const float x = normals.x[lane], y = normals.y[lane], z = normals.z[lane];
    packet.normal_x[lane] = rotation_(0, 0) * x + rotation_(1, 0) * y + rotation_(2, 0) * z;
    packet.normal_y[lane] = rotation_(0, 1) * x + rotation_(1, 1) * y + rotation_(2, 1) * z;
    packet.normal_z[lane] = rotation_(0, 2) * x + rotation_(1, 2) * y + rotation_(2, 2) * z;
  }
  for (int lane = 0; lane < packet_size; ++lane) {
    const bool hit = hits.surface[lane] >= 0;
    packet.depth_m[lane] = hit ? hits.t[lane] : 0.0f;  // the direction's z is 1
    packet.nir_albedo[lane] = hit ? scene_.nir_albedo(hits, lane) : 0.0f;
    packet.chrome[lane] = hit && scene_.surfaces()[hits.surface[lane]].material.chrome;
  }
}

// Rays from the packet's ideal coordinates, for its first `count` lanes.
void IrView::aim(int count, const IrPacket& packet, RayPacket& rays) const {
  for (int lane = 0; lane < packet_size; ++lane) {
    const float x = packet.ideal_x[lane], y = packet.ideal_y[lane];
    rays.direction_x[lane] = rotation_(0, 0) * x + rotation_(0, 1) * y + rotation_(0, 2);
    rays.direction_y[lane] = rotation_(1, 0) * x + rotation_(1, 1) * y + rotation_(1, 2);
    rays.direction_z[lane] = rotation_(2, 0) * x + rotation_(2, 1) * y + rotation_(2, 2);
    rays.origin_x[lane] = position_.x(), rays.origin_y[lane] = position_.y(), rays.origin_z[lane] = position_.z();
    rays.near_t[lane] = near_m, rays.far_t[lane] = far_m;
    rays.valid[lane] = lane < count ? -1 : 0;
  }
}

void IrView::trace_block(int left, int top, IrPacket& packet) const {
  const bool inside = left + block <= width() && top + block <= height();
  for (int lane = 0; lane < packet_size; ++lane) {
    // The ray table has a margin of one pixel; lanes farther out than the image repeat its last one.
    const int x = left + lane % block, y = top + lane / block;
    const Vector2f& ideal = inside ? rays_.at(x, y) : rays_.at(std::min(x, width()), std::min(y, height()));
    packet.ideal_x[lane] = ideal.x(), packet.ideal_y[lane] = ideal.y();
  }
  RayPacket rays{RayPacket::Unset()};
  aim(packet_size, packet, rays);
  if (!inside)
    for (int lane = 0; lane < packet_size; ++lane)
      if (left + lane % block >= width() || top + lane / block >= height()) rays.valid[lane] = 0;
  look_up(rays, packet);
}

std::vector<IrSample> IrView::first_hits() const {
  std::vector<IrSample> result(static_cast<std::size_t>(width()) * height());
  for_each_block([&](int left, int top, const IrPacket& packet) {
    IrSample samples[packet_size];
    unpack(packet, samples);
    for (int lane = 0; lane < packet_size; ++lane) {
      const int x = left + lane % block, y = top + lane / block;
      if (x < width() && y < height()) result[static_cast<std::size_t>(y) * width() + x] = samples[lane];
    }
  });
  return result;
}

void IrView::trace(const Vector2f* pixels, int count, IrPacket& packet) const {
  for (int lane = 0; lane < packet_size; ++lane) {
    const Vector2f ideal = lane < count ? rays_.at(pixels[lane].x(), pixels[lane].y()) : Vector2f(0, 0);
    packet.ideal_x[lane] = ideal.x(), packet.ideal_y[lane] = ideal.y();
  }
  RayPacket rays{RayPacket::Unset()};
  aim(count, packet, rays);
  look_up(rays, packet);
}

void IrView::trace(const Vector2f* pixels, int count, IrSample* samples) const {
  IrPacket packet;
  trace(pixels, count, packet);
  IrSample traced[packet_size];
  unpack(packet, traced);
  std::copy(traced, traced + count, samples);
}

void IrView::trace_labels(const Vector2f* pixels, int count, Label* labels) const {
  RayPacket packet;
  for (int lane = 0; lane < count; ++lane)
    packet.set(lane, position_, direction(rays_.at(pixels[lane].x(), pixels[lane].y())), near_m, far_m);
  HitPacket hits;
  scene_.intersect(packet, hits, Coherence::coherent);
  for (int lane = 0; lane < count; ++lane)
    labels[lane] = hits.surface[lane] < 0 ? Label::none : scene_.surfaces()[hits.surface[lane]].label;
}

}  // namespace dressform
