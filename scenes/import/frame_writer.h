#pragma once
#include <opencv2/core/types.hpp>

#include "scenes/import/import.h"

namespace dressform {

// Where and as what the frames of a recording go.
struct FrameTarget {
  std::filesystem::path session;
  std::string role, sensor;
  RecordingUse use = RecordingUse::scan;
  cv::Size color_size, depth_size;  // that every frame must have
};

// Reads, checks and writes the frames' images to where the session keeps them; frames side by side, as many in memory
// as there are threads. Depth comes out in millimetres, 0 where the recording has none. Notes say what was found on the
// way: pixels with a code for no depth, frames that repeat others bit for bit, frames without any depth.
// Throws InputError naming the first file that is wrong, or the recording where its depth cannot be that of a person in
// a room.
void write_frames(const std::vector<RecordedFrame>& frames, const Recording& recording, const FrameTarget& target,
                  const std::filesystem::path& folder, std::vector<std::string>& notes);

}  // namespace dressform
