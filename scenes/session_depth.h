#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace dressform {

// What the depth images of one shot or scan hold, to tell whether they can be what they are said to be. Images are
// uint16, millimetres, 0 = none. A sample of every image's pixels is counted.
class DepthTally {
 public:
  void add(const cv::Mat& depth_mm);
  void add(const DepthTally& other);

  long sampled() const { return sampled_; }
  long valid() const { return valid_; }
  // Depth that this part of the sampled valid pixels does not exceed, metres, to 16 mm; 0 without any.
  double quantile_m(double part) const;

 private:
  static constexpr int kShift = 4, kBins = 65536 >> kShift;
  long sampled_ = 0, valid_ = 0;
  std::array<std::uint32_t, kBins> bins_{};
};

// Values that recorders write where there is no depth and that are the largest of their kind: all ones in 11 to 16
// bits. The one that the image holds as its largest value at so many pixels that no surface explains it; 65535 always.
std::optional<int> saturation_code(const cv::Mat& depth);

// Why an image that should say 0 where it has no depth does not; empty: it may. For sessions, which are read strictly.
std::string problem_with_depth_code(const cv::Mat& depth_mm);

// Range of distances at which a person or a room is recorded; a sensor's own may be narrower.
struct DepthRange {
  double nearest_m = 0.25, farthest_m = 10;
};
// Why depth cannot be that of a person in a room (no depth at all, everything too near or too far), in metres, with the
// scale that the values look like where they were counted as `per_m` a metre; empty: it may be.
std::string problem_with_depth(const DepthTally& tally, const DepthRange& range = {}, double per_m = 1000);

}  // namespace dressform
