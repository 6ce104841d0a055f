#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>

#include "scenes/capture_session.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// An image as noisy as a sensor's: PNG's speed depends on it.
cv::Mat image(int width, int height, int type, int sigma) {
  cv::Mat image(height, width, type), noise(height, width, CV_MAKETYPE(CV_16S, CV_MAT_CN(type)));
  cv::RNG generator(7);
  generator.fill(noise, cv::RNG::NORMAL, 0, sigma);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width * image.channels(); ++x) {
      const int value =
          (type == CV_16UC1 ? 2100 : 110) + static_cast<int>(60 * std::sin(x * 0.01) * std::cos(y * 0.02));
      const int noisy = value + noise.ptr<short>(y)[x];
      if (type == CV_16UC1)
        image.ptr<ushort>(y)[x] = static_cast<ushort>(noisy);
      else
        image.ptr<uchar>(y)[x] = cv::saturate_cast<uchar>(noisy);
    }
  return image;
}

CaptureSession full_session() {
  CaptureSession session;
  session.name = "bench";
  session.calibration.emplace();
  const Shot shot{image(1920, 1080, CV_8UC3, 2), image(512, 424, CV_16UC1, 3), image(512, 424, CV_16UC1, 30), {}, {}};
  for (const char* name : {"k1", "k2", "k3", "k4"}) {
    session.sensors.push_back(name);
    SensorCalibration sensor;
    sensor.color = Camera{1920, 1080, 1070, 1070, 960, 540, {}};
    sensor.ir = Camera{512, 424, 365, 365, 256, 212, {}};
    session.calibration->sensors[name] = sensor;
    session.naked[name] = session.dressed[name] = shot;
  }
  session.calibration->sensors["handheld"].ir = Camera{512, 424, 365, 365, 256, 212, {}};
  for (const char* name : {"scan_naked", "scan_user"})
    session.scans[name] = {"handheld", std::vector<cv::Mat>(120, shot.depth_mm)};
  return session;
}

void write_session(benchmark::State& state) {
  const CaptureSession session = full_session();
  const fs::path folder = fs::temp_directory_path() / "dressform_session_bench";
  for (auto _ : state) {
    fs::remove_all(folder);
    write_capture_session(folder, session);
  }
  fs::remove_all(folder);
}
BENCHMARK(write_session)->Unit(benchmark::kMillisecond)->UseRealTime();

void read_session(benchmark::State& state) {
  const fs::path folder = fs::temp_directory_path() / "dressform_session_bench";
  fs::remove_all(folder);
  write_capture_session(folder, full_session());
  for (auto _ : state) benchmark::DoNotOptimize(read_capture_session(folder));
  fs::remove_all(folder);
}
BENCHMARK(read_session)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace dressform
