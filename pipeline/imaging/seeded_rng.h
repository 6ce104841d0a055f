#pragma once
#include <cstdint>
#include <opencv2/core.hpp>

namespace dressform {

// OpenCV's random numbers of this thread, seeded; as they were before when it goes out of scope. grabCut and kmeans
// draw from them, and whatever ran on the thread before would show in their results.
class SeededRng {
 public:
  explicit SeededRng(std::uint64_t seed) : before_(cv::theRNG()) { cv::theRNG() = cv::RNG(seed + 1); }  // 0 is none
  ~SeededRng() { cv::theRNG() = before_; }
  SeededRng(const SeededRng&) = delete;
  SeededRng& operator=(const SeededRng&) = delete;

 private:
  cv::RNG before_;
};

}  // namespace dressform
