#include "scenes/import/frame_writer.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>
#include <opencv2/core.hpp>

#include "scenes/error.h"
#include "scenes/hash.h"
#include "scenes/image_file.h"
#include "scenes/session_layout.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// What one frame's depth was found to hold.
struct FrameFacts {
  std::string hash;   // of its pixels; empty: no depth at all
  long no_depth = 0;  // pixels with a code for none
};

struct FrameReading {
  const Recording& recording;
  const FrameTarget& target;
};

// Millimetres for every value that a depth image can hold, 0 for codes; what 16 bits of millimetres cannot say is none.
std::vector<std::uint16_t> millimetres_of(const std::vector<int>& no_depth, double per_m) {
  std::vector<std::uint16_t> table(65536);
  for (int raw = 0; raw < 65536; ++raw) {
    const double mm = std::nearbyint(raw * 1000.0 / per_m);
    if (mm < 65535 && std::find(no_depth.begin(), no_depth.end(), raw) == no_depth.end())
      table[raw] = static_cast<std::uint16_t>(mm);
  }
  return table;
}

cv::Mat depth_in_mm(const cv::Mat& depth, const Recording& recording, double per_m, FrameFacts& facts) {
  thread_local std::vector<std::uint16_t> table;  // one scale and one set of codes for nearly all frames
  thread_local std::pair<std::vector<int>, double> made_for{{}, 0};
  if (const std::pair wanted(recording.no_depth, per_m); made_for != wanted)
    table = millimetres_of(recording.no_depth, per_m), made_for = wanted;
  cv::Mat result(depth.size(), CV_16UC1);
  for (int y = 0; y < depth.rows; ++y) {
    const auto* from = depth.ptr<std::uint16_t>(y);
    auto* to = result.ptr<std::uint16_t>(y);
    for (int x = 0; x < depth.cols; ++x) {
      to[x] = table[from[x]];
      facts.no_depth += to[x] == 0 && 1000.0 * from[x] > per_m;  // beyond a metre, and yet none: a code
    }
  }
  return result;
}

void check_code(const cv::Mat& depth, const Recording& recording, const fs::path& file) {
  const auto code = saturation_code(depth);
  if (!code || std::count(recording.no_depth.begin(), recording.no_depth.end(), *code)) return;
  throw InputError(
      file.string(),
      fmt::format("found {} (0x{:X}) in {} of {} pixels and nothing beyond, which looks like a code for no "
                  "depth; expected depth (say so with the format's no_depth = {}, or in its layout)",
                  *code, *code, cv::countNonZero(depth == *code), depth.total(), *code));
}

// Reads, checks and writes one frame.
FrameFacts write_frame(const RecordedFrame& frame, int index, const FrameReading& reading, DepthTally& tally) {
  const auto& [recording, target] = reading;
  FrameFacts facts;
  const cv::Mat raw = read_image(frame.depth, kDepthImage, target.depth_size);
  check_code(raw, recording, frame.depth);
  const cv::Mat depth =
      depth_in_mm(raw, recording, frame.depth_per_m > 0 ? frame.depth_per_m : recording.depth_per_m, facts);
  tally.add(depth);
  if (cv::countNonZero(depth) > 0)
    facts.hash = hash_hex({reinterpret_cast<const char*>(depth.data), depth.total() * depth.elemSize()});
  if (target.use == RecordingUse::scan) {
    write_png(target.session / target.role / session_layout::depth_frame(index), depth);
    return facts;
  }
  const bool boards = target.use == RecordingUse::boards;
  const fs::path folder = target.session / target.role / target.sensor;
  const auto file = [&](const char* what) {
    return folder / (boards ? session_layout::board_image(index, what) : std::string(what) + ".png");
  };
  write_png(file("color"), read_image(frame.color, kColorOrGreyImage, target.color_size));
  if (!frame.ir.empty()) write_png(file("ir"), read_image(frame.ir, kDepthImage, target.depth_size));
  write_png(file("depth"), depth);
  return facts;
}

// The same bits twice are a recorder's (or an exporter's) repetition: sensors have noise.
void note_repetitions(const std::vector<RecordedFrame>& frames, const std::vector<FrameFacts>& facts,
                      std::vector<std::string>& notes) {
  std::map<std::string, std::size_t> first;
  std::string example;
  int repeated = 0;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (facts[i].hash.empty()) continue;
    const auto [earlier, is_new] = first.emplace(facts[i].hash, i);
    if (is_new) continue;
    ++repeated;
    if (example.empty())
      example = frames[i].depth.filename().string() + " is " + frames[earlier->second].depth.filename().string();
  }
  if (repeated > 0)
    notes.push_back(
        fmt::format("{} of {} depth frames are identical to an earlier one, bit for bit ({}): repeated "
                    "frames tell nothing of noise or motion",
                    repeated, facts.size(), example));
}

void note_missing_depth(const std::vector<FrameFacts>& facts, const Recording& recording, const FrameTarget& target,
                        std::vector<std::string>& notes) {
  const auto empty = std::count_if(facts.begin(), facts.end(), [](const auto& each) { return each.hash.empty(); });
  if (empty > 0)
    notes.push_back(
        fmt::format("no depth in {} of {} depth images: every pixel is 0{}", empty, facts.size(),
                    target.use == RecordingUse::boards ? ", so that no depth offset can be found from them" : ""));
  long pixels = 0;
  for (const auto& each : facts) pixels += each.no_depth;
  if (pixels == 0) return;
  std::string codes;
  for (const int code : recording.no_depth)
    if (code > 0) codes += (codes.empty() ? "" : " or ") + std::to_string(code);
  notes.push_back(fmt::format(
      "{:.2f} % of the depth pixels have {}: taken to be no depth",
      100.0 * static_cast<double>(pixels) / (static_cast<double>(facts.size()) * target.depth_size.area()), codes));
}

void check_distances(const DepthTally& tally, const Recording& recording, const FrameTarget& target,
                     const fs::path& folder) {
  if (target.use == RecordingUse::boards && tally.valid() == 0) return;  // a note says so
  const std::string problem = problem_with_depth(tally, recording.range, recording.depth_per_m);
  if (problem.empty()) return;
  std::string scale = fmt::format(", counted as {:g} a metre", recording.depth_per_m);
  if (!recording.depth_scale_option.empty()) scale += ": " + recording.depth_scale_option + "=... says another scale";
  throw InputError(folder.string(), "depth images: " + problem + (tally.valid() > 0 ? scale : ""));
}

}  // namespace

void write_frames(const std::vector<RecordedFrame>& frames, const Recording& recording, const FrameTarget& target,
                  const fs::path& folder, std::vector<std::string>& notes) {
  fs::create_directories(target.use == RecordingUse::scan ? target.session / target.role
                                                          : target.session / target.role / target.sensor);
  std::vector<std::exception_ptr> errors(frames.size());
  std::vector<FrameFacts> facts(frames.size());
  DepthTally all;
  std::mutex mutex;
  tbb::parallel_for(std::size_t(0), frames.size(), [&](std::size_t i) {
    try {
      DepthTally tally;
      facts[i] = write_frame(frames[i], static_cast<int>(i), {recording, target}, tally);
      const std::lock_guard lock(mutex);
      all.add(tally);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
  check_distances(all, recording, target, folder);
  note_repetitions(frames, facts, notes);
  note_missing_depth(facts, recording, target, notes);
}

}  // namespace dressform
