#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scenes/import/import.h"

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

// Image files that a text file lists, one "stamp path" a line, `#` for comments. One unit of a stamp is `unit_s`
// seconds. Throws InputError naming the line where a stamp is no number or does not increase, or a path leaves
// `folder`.
std::vector<StampedFile> listed_files(const std::filesystem::path& folder, const std::string& name, double unit_s = 1);

// Pairs (index of a, index of b) nearest in time, each file in one pair at most, no further apart than `tolerance_s`;
// the nearest pair is taken first. In the order of a. Stamps must increase.
std::vector<std::pair<int, int>> associate(const std::vector<StampedFile>& a, const std::vector<StampedFile>& b,
                                           double tolerance_s);

// Keeps of `depth` what has a partner in `color`, with it; a note says how many were left out. Tolerance 0: of the same
// number. Throws InputError naming `where` when fewer than half have one: the two streams do not belong together.
struct DepthAndColor {
  StampedFile depth, color;
};
std::vector<DepthAndColor> with_partners(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& color,
                                         double tolerance_s, const std::string& where, std::vector<std::string>& notes);

// What recordings of a depth stream beside a colour stream leave open.
struct StreamParams {
  double depth_per_m = 1000, tolerance_ms = 20;
  int no_depth = 65535;
};

template <class V>
void fields(V& v, StreamParams& p) {
  v("depth_per_m", p.depth_per_m, 1.0, 100000.0, "1/m", "what depth images count in");
  v("tolerance_ms", p.tolerance_ms, 0.0, 1000.0, "ms", "how far apart in time depth and colour of one moment may be");
  v("no_depth", p.no_depth, 0, 65535, "",
    "value of depth images that means none, besides 0 and 65535: 2047, 4095, ... of some recorders");
}

// Frames of depth with colour where it was recorded, as the params have them.
void set_stream(Recording& recording, const StreamParams& params);

// Throws InputError that says why a recording without infrared images holds no boards.
[[noreturn]] void fail_without_infrared(const std::filesystem::path& recording);

}  // namespace dressform
