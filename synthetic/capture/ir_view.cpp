#include "synthetic/capture/ir_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr int block = 4;  // one packet is a 4 x 4 block of pixels
constexpr float near_m = 0.2f, far_m = 30.0f;

}  // namespace

IrView::IrView(const RayScene& scene, const RayTable& rays, const Camera& camera, const Isometry3d& world_from_sensor,
               double depth_offset_m, bool wants_infrared)
    : scene_(scene),
      rays_(rays),
      camera_(camera),
      world_from_sensor_(world_from_sensor),
      depth_offset_m_(depth_offset_m),
      wants_infrared_(wants_infrared),
      rotation_(world_from_sensor.linear().cast<float>()),
      position_(world_from_sensor.translation().cast<float>()) {}

Vector3f IrView::direction(const Vector2f& ideal) const { return rotation_ * Vector3f(ideal.x(), ideal.y(), 1.0f); }

void IrView::trace_packet(const RayPacket& packet, IrSample (&samples)[packet_size]) const {
  HitPacket hits;
  scene_.intersect(packet, hits, Coherence::coherent);
  for (int lane = 0; lane < packet_size; ++lane) {
    samples[lane] = {};
    if (hits.surface[lane] < 0) continue;
    const Vector3f direction = packet.direction(lane);
    const float length = direction.norm();
    IrSample& sample = samples[lane];
    sample.depth_m = hits.t[lane];  // the direction's z is 1
    sample.distance_m = hits.t[lane] * length;
    const Vector3f normal = scene_.normal(packet, hits, lane);
    sample.cos_incidence = std::clamp(-normal.dot(direction) / length, 0.0f, 1.0f);
    sample.nir_albedo = scene_.nir_albedo(hits, lane);
    sample.chrome = scene_.surfaces()[hits.surface[lane]].material.chrome;
    if (sample.chrome) sample.mirror_cos = 2 * sample.cos_incidence * sample.cos_incidence - 1;
  }
}

std::vector<IrSample> IrView::first_hits() const {
  const int columns = (width() + block - 1) / block, rows = (height() + block - 1) / block;
  std::vector<IrSample> result(static_cast<std::size_t>(width()) * height());
  tbb::parallel_for(0, rows, [&](int row) {
    for (int column = 0; column < columns; ++column) {
      RayPacket packet;
      for (int lane = 0; lane < packet_size; ++lane) {
        const int x = column * block + lane % block, y = row * block + lane / block;
        if (x < width() && y < height()) packet.set(lane, position_, direction(rays_.at(x, y)), near_m, far_m);
      }
      IrSample samples[packet_size];
      trace_packet(packet, samples);
      for (int lane = 0; lane < packet_size; ++lane) {
        const int x = column * block + lane % block, y = row * block + lane / block;
        if (x < width() && y < height()) result[static_cast<std::size_t>(y) * width() + x] = samples[lane];
      }
    }
  });
  return result;
}

void IrView::trace(const Vector2f* pixels, int count, IrSample* samples) const {
  RayPacket packet;
  for (int lane = 0; lane < count; ++lane)
    packet.set(lane, position_, direction(rays_.at(pixels[lane].x(), pixels[lane].y())), near_m, far_m);
  IrSample traced[packet_size];
  trace_packet(packet, traced);
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
