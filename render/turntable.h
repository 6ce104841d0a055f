#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace dressform {

struct TurntableOptions {
  int frames = 48;  // of one whole turn
  int height_px = 720;
  double elevation_deg = 8;
  double frames_per_second = 24;
};

// Views of one turn about the vertical, all of one size; the last is one step before the first.
std::vector<cv::Mat> turntable_frames(Renderer& renderer, const std::vector<RenderItem>& items,
                                      const TurntableOptions& options);

// Writes an animation that goes round for ever: .webp or .mp4 through ffmpeg. Where there is no ffmpeg, or for a path
// without such an ending, a folder of that name (without the ending) with frame_000.png, ... Returns what was written.
// Throws InputError where ffmpeg fails, naming the file and ffmpeg's last words.
std::filesystem::path write_animation(const std::vector<cv::Mat>& frames, double frames_per_second,
                                      const std::filesystem::path& file);

// Whether animations can be written.
bool has_ffmpeg();

}  // namespace dressform
