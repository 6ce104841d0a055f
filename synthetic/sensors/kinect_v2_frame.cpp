#include "synthetic/sensors/kinect_v2_frame.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "scenes/random.h"
#include "synthetic/sensors/bounce_map.h"
#include "synthetic/sensors/tof_decode.h"

namespace dressform {
namespace {

// Images of floats, one after the other in one piece of memory that is written before it is read.
template <int planes>
class Planes {
 public:
  Planes(int width, int height)
      : width_(width), plane_(static_cast<std::size_t>(width) * height), values_(new float[planes * plane_]) {}
  float* row(int plane, int y) { return &values_[plane * plane_ + static_cast<std::size_t>(y) * width_]; }
  const float* row(int plane, int y) const { return const_cast<Planes*>(this)->row(plane, y); }

 private:
  int width_;
  std::size_t plane_;
  std::unique_ptr<float[]> values_;
};

// What one ray through each pixel's centre brings back.
enum Seen { depth_m, path_mm, direct, gain, relief_mm, seen_planes };
// Phasors, by frequency: cosine, sine, amplitude.
constexpr int phasor_planes = 3 * tof::frequencies;
enum Decoded { decoded_mm, amplitude_sum, worst_delta, decoded_planes };
constexpr int normals_per_pixel = tof::raw_samples + 1;  // the last one is for the relief

template <class Body>
void for_each_row(int rows, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(0, rows, 8), [&](const tbb::blocked_range<int>& range) { body(range); });
}

class KinectV2 {
 public:
  KinectV2(const IrView& view, const KinectV2Params& params, Seed seed)
      : view_(view),
        params_(params),
        seed_(seed),
        width_(view.width()),
        height_(view.height()),
        lamp_{static_cast<float>(params.signal), static_cast<float>(params.falloff),
              static_cast<float>(params.chrome_albedo), static_cast<float>(params.relief)},
        electronics_(electronics()),
        errors_(frame_errors()) {}

  SensorFrame frame() const {
    SensorFrame result{cv::Mat(height_, width_, CV_16UC1), cv::Mat()};
    if (view_.wants_infrared()) result.ir.create(height_, width_, CV_16UC1);
    const auto phasors = capture(look(), BounceMap(view_, params_.falloff, params_.multipath), result.ir);
    finish(decode(phasors), result.depth_mm);
    return result;
  }

 private:
  tof::Electronics electronics() const {
    tof::Electronics result;
    result.noise_scale = static_cast<float>(params_.noise_scale);
    result.read_variance = static_cast<float>(params_.read_noise * params_.read_noise);
    result.shot = static_cast<float>(params_.shot_noise);
    result.relative = static_cast<float>(params_.relative_noise);
    result.ambient = static_cast<float>(params_.ambient);
    result.companding = params_.companding;
    return result;
  }

  tof::FrameErrors frame_errors() const {
    tof::FrameErrors errors;
    errors.clip = static_cast<float>(params_.clip);
    const auto random = uniform4(seed_, stream_of("interference"), 0);
    if (random[0] >= params_.interference_chance) return errors;
    for (int s = 0; s < tof::raw_samples; ++s)
      errors.interference[s] =
          static_cast<float>(params_.interference_leak * std::cos(2 * M_PI * (random[1 + s / 3] + (s % 3) / 3.0)));
    return errors;
  }

  Planes<seen_planes> look() const {
    Planes<seen_planes> seen(width_, height_);
    view_.for_each_block([&](int left, int top, const IrPacket& packet) {
      tof::Returned returned;
      tof::illuminate(packet, lamp_, returned);
      for (int lane = 0; lane < packet_size; ++lane) {
        const int x = left + lane % IrView::block, y = top + lane / IrView::block;
        if (x >= width_ || y >= height_) continue;
        seen.row(depth_m, y)[x] = packet.depth_m[lane];
        seen.row(path_mm, y)[x] = returned.path_mm[lane];
        seen.row(direct, y)[x] = returned.direct[lane];
        seen.row(gain, y)[x] = returned.gain[lane];
        seen.row(relief_mm, y)[x] = returned.relief_mm[lane];
      }
    });
    return seen;
  }

  // Whether a step in depth lies within a pixel's reach. The second difference is blind to slope: a floor is no edge.
  void find_edges(const Planes<seen_planes>& seen, int y, std::vector<int>& edges) const {
    const float* above = seen.row(depth_m, std::max(0, y - 1));
    const float* row = seen.row(depth_m, y);
    const float* below = seen.row(depth_m, std::min(height_ - 1, y + 1));
    const float gap_m = static_cast<float>(params_.edge_gap_m);
    edges.clear();
    for (int x = 0; x < width_; ++x) {
      const int left = std::max(0, x - 1), right = std::min(width_ - 1, x + 1);
      const float twice = 2 * row[x];
      const float bend = std::max(
          std::max(std::abs(row[left] + row[right] - twice), std::abs(above[x] + below[x] - twice)),
          std::max(std::abs(above[left] + below[right] - twice), std::abs(above[right] + below[left] - twice)));
      if (bend > gap_m) edges.push_back(x);
    }
  }

  // Mixed pixels: the mean of the samples of 4 x 4 points. Depths are never averaged.
  void mix(int x, int y, const float* terms, float relief, float* const (&samples)[tof::raw_samples],
           float* light) const {
    Vector2f pixels[packet_size];
    for (int i = 0; i < packet_size; ++i) pixels[i] = {x + (i % 4 - 1.5f) / 4, y + (i / 4 - 1.5f) / 4};
    IrPacket packet;
    view_.trace(pixels, packet_size, packet);
    tof::Returned returned;
    tof::illuminate(packet, lamp_, returned);
    float bounce[tof::bounce_terms][packet_size], part[tof::raw_samples][packet_size], part_light[packet_size];
    tof::Points points{returned.path_mm, returned.direct, returned.gain, {}};
    for (int t = 0; t < tof::bounce_terms; ++t) {
      std::fill(bounce[t], bounce[t] + packet_size, terms[static_cast<std::ptrdiff_t>(t) * width_ + x]);
      points.bounce[t] = bounce[t];
    }
    for (int i = 0; i < packet_size; ++i) returned.path_mm[i] += returned.relief_mm[i] * relief;
    float* parts[tof::raw_samples];
    for (int s = 0; s < tof::raw_samples; ++s) parts[s] = part[s];
    tof::expose(points, errors_, packet_size, parts, part_light);
    const auto mean = [](const float* values) {
      float sum = 0;
      for (int i = 0; i < packet_size; ++i) sum += values[i];
      return sum / packet_size;
    };
    for (int s = 0; s < tof::raw_samples; ++s) samples[s][x] = mean(part[s]);
    light[x] = mean(part_light);
  }

  struct RowBuffers {
    explicit RowBuffers(int width)
        : normal_blocks((normals_per_pixel * width + normal_block - 1) / normal_block),
          normals(static_cast<std::size_t>(normal_blocks) * normal_block),
          terms(static_cast<std::size_t>(tof::bounce_terms) * width),
          raw(static_cast<std::size_t>(tof::raw_samples) * width),
          light(width),
          path(width) {
      for (int s = 0; s < tof::raw_samples; ++s) samples[s] = &raw[static_cast<std::size_t>(s) * width];
    }
    int normal_blocks;
    std::vector<float> normals, terms, raw, light, path;
    std::vector<int> edges;
    float* samples[tof::raw_samples];
  };

  void capture_row(int y, const Planes<seen_planes>& seen, const BounceMap& bounce, RowBuffers& buffers,
                   const tof::PhasorRow& out) const {
    fill_normals(seed_, stream_of("raw samples"), static_cast<std::uint64_t>(y) * buffers.normal_blocks,
                 buffers.normal_blocks, buffers.normals.data());
    const float* relief = buffers.normals.data() + static_cast<std::ptrdiff_t>(tof::raw_samples) * width_;
    bounce.row(y, seen.row(depth_m, y), buffers.terms.data());
    for (int x = 0; x < width_; ++x) buffers.path[x] = seen.row(path_mm, y)[x] + seen.row(relief_mm, y)[x] * relief[x];
    tof::Points points{buffers.path.data(), seen.row(direct, y), seen.row(gain, y), {}};
    for (int t = 0; t < tof::bounce_terms; ++t)
      points.bounce[t] = buffers.terms.data() + static_cast<std::ptrdiff_t>(t) * width_;
    tof::expose(points, errors_, width_, buffers.samples, buffers.light.data());
    find_edges(seen, y, buffers.edges);
    for (const int x : buffers.edges) mix(x, y, buffers.terms.data(), relief[x], buffers.samples, buffers.light.data());
    tof::read_out(buffers.samples, buffers.light.data(), buffers.normals.data(), electronics_, width_, out);
  }

  void write_infrared(const tof::PhasorRow& row, std::uint16_t* out) const {
    for (int x = 0; x < width_; ++x) {
      const float sum = row.amplitude[0][x] + row.amplitude[1][x] + row.amplitude[2][x];
      const float value = row.amplitude[0][x] < 0 ? 65535.0f : std::min(65535.0f, sum * (16.0f / 3));
      out[x] = static_cast<std::uint16_t>(value + 0.5f);
    }
  }

  Planes<phasor_planes> capture(const Planes<seen_planes>& seen, const BounceMap& bounce, cv::Mat& ir) const {
    Planes<phasor_planes> phasors(width_, height_);
    for_each_row(height_, [&](const tbb::blocked_range<int>& range) {
      RowBuffers buffers(width_);
      for (int y = range.begin(); y < range.end(); ++y) {
        tof::PhasorRow out;
        for (int f = 0; f < tof::frequencies; ++f) {
          out.cosine[f] = phasors.row(3 * f, y);
          out.sine[f] = phasors.row(3 * f + 1, y);
          out.amplitude[f] = phasors.row(3 * f + 2, y);
        }
        capture_row(y, seen, bounce, buffers, out);
        if (!ir.empty()) write_infrared(out, ir.ptr<std::uint16_t>(y));
      }
    });
    return phasors;
  }

  static tof::PhasorRows::Row phasor_row(const Planes<phasor_planes>& phasors, int y) {
    tof::PhasorRows::Row row;
    for (int f = 0; f < tof::frequencies; ++f) {
      row.cosine[f] = phasors.row(3 * f, y);
      row.sine[f] = phasors.row(3 * f + 1, y);
      row.amplitude[f] = phasors.row(3 * f + 2, y);
    }
    return row;
  }

  Planes<decoded_planes> decode(const Planes<phasor_planes>& phasors) const {
    Planes<decoded_planes> decoded(width_, height_);
    for_each_row(height_, [&](const tbb::blocked_range<int>& range) {
      std::vector<float> buffer(static_cast<std::size_t>(2 * tof::frequencies + 2) * width_);
      const auto part = [&](int i) { return &buffer[static_cast<std::size_t>(i) * width_]; };
      float *ideal_x = part(6), *ideal_y = part(7);
      for (int y = range.begin(); y < range.end(); ++y) {
        const int above = std::max(0, y - 1), below = std::min(height_ - 1, y + 1);
        const tof::PhasorRows rows{phasor_row(phasors, above), phasor_row(phasors, y), phasor_row(phasors, below)};
        const tof::FilteredRow filtered{
            {part(0), part(1), part(2)}, {part(3), part(4), part(5)}, decoded.row(worst_delta, y)};
        const bool border = y == 0 || y == height_ - 1;
        (params_.bilateral && !border ? tof::bilateral : tof::copy_unfiltered)(rows, width_, filtered);
        for (int x = 0; x < width_; ++x) {
          const Vector2f& ideal = view_.ideal(x, y);
          ideal_x[x] = ideal.x(), ideal_y[x] = ideal.y();
        }
        tof::unwrap(filtered, rows, ideal_x, ideal_y, width_, decoded.row(decoded_mm, y),
                    decoded.row(amplitude_sum, y));
      }
    });
    return decoded;
  }

  // Millimetres that are added to every depth.
  double offset_mm() const {
    const double own = params_.offset_sigma_mm * normal(stream_of("kinect v2"), stream_of("offset"), view_.device());
    return 1000 * view_.depth_offset_m() + params_.offset_mm + own +
           params_.warm_up_mm * std::exp(-params_.minutes_on / 10);
  }

  void finish(const Planes<decoded_planes>& decoded, cv::Mat& depth) const {
    const float offset = static_cast<float>(offset_mm());
    const float least = static_cast<float>(1000 * params_.minimum_m),
                most = static_cast<float>(1000 * params_.maximum_m);
    for_each_row(height_, [&](const tbb::blocked_range<int>& range) {
      std::vector<float> filtered(width_);
      for (int y = range.begin(); y < range.end(); ++y) {
        tof::DecodedRows rows;
        for (int i = 0; i < 3; ++i) {
          const int row = std::clamp(y + i - 1, 0, height_ - 1);
          rows.depth_mm[i] = decoded.row(decoded_mm, row), rows.amplitude_sum[i] = decoded.row(amplitude_sum, row);
        }
        std::copy(rows.depth_mm[1], rows.depth_mm[1] + width_, filtered.begin());
        if (params_.edge_filter && y > 0 && y < height_ - 1) tof::edge_filter(rows, width_, filtered.data());
        const float* delta = decoded.row(worst_delta, y);
        for (int x = 0; x < width_; ++x) {
          const float z = filtered[x];
          const bool rejected = params_.edge_filter && delta[x] >= tof::worst_delta_allowed;
          const bool good = z >= least && z <= most && !rejected;
          depth.at<std::uint16_t>(y, x) = good ? static_cast<std::uint16_t>(std::max(0.0f, z + offset + 0.5f)) : 0;
        }
      }
    });
  }

  const IrView& view_;
  const KinectV2Params& params_;
  Seed seed_;
  int width_, height_;
  tof::Lamp lamp_;
  tof::Electronics electronics_;
  tof::FrameErrors errors_;
};

}  // namespace

SensorFrame kinect_v2_frame(const IrView& view, const KinectV2Params& params, Seed seed) {
  return KinectV2(view, params, seed).frame();
}

}  // namespace dressform
