#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dressform {

// An image of a recording and the time it was taken.
struct StampedFile {
  double stamp_s = 0;
  std::filesystem::path path;
};

// Image files of a folder that are named by numbers, in their order: "00012.png" has the stamp 12, and
// "0000013-000000400400.png" 0.4004 (frame and microseconds: `timed`). Throws InputError where the folder is
// missing, a name has no number, names are of both kinds, or two files have the same number.
struct NumberedFiles {
  std::vector<StampedFile> files;
  bool timed = false;
};
NumberedFiles numbered_files(const std::filesystem::path& folder);

// Pairs (index of a, index of b) nearest in time, each file in one pair at most, no further apart than `tolerance_s`;
// the nearest pair is taken first. In the order of a. Stamps must increase.
std::vector<std::pair<int, int>> associate(const std::vector<StampedFile>& a, const std::vector<StampedFile>& b,
                                           double tolerance_s);

// Keeps of `depth` what has a partner in `color`; a note says how many were left out. Tolerance 0: of the same number.
// Throws InputError naming `where` when fewer than half have one: the two streams do not belong together.
std::vector<StampedFile> with_partners(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& color,
                                       double tolerance_s, const std::string& where, std::vector<std::string>& notes);

// What recordings of a depth stream beside a colour stream leave open.
struct StreamParams {
  double depth_per_m = 1000, tolerance_ms = 20;
};

template <class V>
void fields(V& v, StreamParams& p) {
  v("depth_per_m", p.depth_per_m, 1000.0, 65535.0, "1/m", "what depth images count in");
  v("tolerance_ms", p.tolerance_ms, 0.0, 1000.0, "ms", "how far apart in time depth and colour of one moment may be");
}

// Throws InputError that says why a recording without infrared images is no shot and no board.
[[noreturn]] void fail_without_infrared(const std::filesystem::path& recording);

}  // namespace dressform
