#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace dressform {

struct VolumeOptions {
  double voxel_m = 0.004;
  double truncation_m = 0.012;
  double min_cosine = 0.3;  // between normal and line of sight, of an observation
};

// Truncated distances of 8 x 8 x 8 voxels, x fastest.
struct VoxelBlock {
  using Cell = Eigen::Vector3i;
  static constexpr int kEdge = 8, kVoxels = kEdge * kEdge * kEdge;
  float distance[kVoxels] = {};  // metres, positive outside
  float weight[kVoxels] = {};
  std::uint16_t observations[kVoxels] = {};

  static int index(const Cell& local) { return (local.z() * kEdge + local.y()) * kEdge + local.x(); }

  // A block's place as one number, and back: 21 bits a coordinate.
  static std::uint64_t key_of(const Cell& block) {
    const auto part = [](int c) { return static_cast<std::uint64_t>(c + kKeyOffset); };
    return (part(block.x()) << (2 * kKeyBits)) | (part(block.y()) << kKeyBits) | part(block.z());
  }
  static Cell block_of(std::uint64_t key) {
    const auto part = [](std::uint64_t c) { return static_cast<int>(c & ((1u << kKeyBits) - 1)) - kKeyOffset; };
    return {part(key >> (2 * kKeyBits)), part(key >> kKeyBits), part(key)};
  }
  // The block that a point lies in; block_m: the edge of a block.
  static Cell block_at(const Eigen::Vector3f& point, float block_m) {
    const Eigen::Vector3f at = point / block_m;
    return {static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
            static_cast<int>(std::floor(at.z()))};
  }
  // The block of a voxel.
  static Cell block_of_voxel(const Cell& voxel) {
    const auto part = [](int c) { return c >= 0 ? c / kEdge : -((-c + kEdge - 1) / kEdge); };
    return {part(voxel.x()), part(voxel.y()), part(voxel.z())};
  }

 private:
  static constexpr int kKeyBits = 21, kKeyOffset = 1 << 20;
};

}  // namespace dressform
