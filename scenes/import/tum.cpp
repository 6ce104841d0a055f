#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "scenes/error.h"
#include "scenes/import/import.h"
#include "scenes/import/stamped_files.h"

// Recordings of the RGB-D benchmark: Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012.
// depth.txt and rgb.txt list stamps (seconds) and images; depth is 16-bit, 5000 a metre, on colour's grid.
namespace dressform {
namespace {

namespace fs = std::filesystem;

struct TumParams : StreamParams {
  TumParams() { depth_per_m = 5000; }
};

// One line of a list: stamp and path.
StampedFile listed_file(const fs::path& folder, const std::string& where, const std::string& line) {
  std::istringstream words(line);
  StampedFile file;
  std::string path;
  if (!(words >> file.stamp_s >> path) || !std::isfinite(file.stamp_s))
    throw InputError(where, "found \"" + line + "\"; expected a stamp and a path");
  const fs::path relative = fs::path(path).lexically_normal();
  if (relative.is_absolute() || *relative.begin() == "..")
    throw InputError(where, "found \"" + path + "\"; expected a path inside the recording");
  file.path = folder / relative;
  return file;
}

std::vector<StampedFile> read_list(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name;
  std::ifstream in(file);
  if (!in || fs::is_directory(file))
    throw InputError(file.string(), "is missing; expected a list of stamps and images");
  std::vector<StampedFile> files;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    const std::string where = file.string() + ":" + std::to_string(number);
    files.push_back(listed_file(folder, where, line));
    if (files.size() > 1 && files.back().stamp_s <= files[files.size() - 2].stamp_s)
      throw InputError(where, fmt::format("found stamp {:.6f} after {:.6f}; expected stamps that increase",
                                          files.back().stamp_s, files[files.size() - 2].stamp_s));
  }
  if (files.empty()) throw InputError(file.string(), "found no images; expected a line for each");
  return files;
}

Recording tum(const fs::path& folder, const RecordingUse& use, const TumParams& params) {
  if (use != RecordingUse::scan) fail_without_infrared(folder);
  Recording recording;
  recording.sensor.model = "kinect_v1";
  recording.prime_sense = true;
  recording.depth_per_m = params.depth_per_m;
  auto depth = read_list(folder, "depth.txt");
  if (fs::exists(folder / "rgb.txt"))
    depth = with_partners(depth, read_list(folder, "rgb.txt"), 1e-3 * params.tolerance_ms,
                          (folder / "depth.txt").string(), recording.notes);
  else
    recording.notes.push_back("no rgb.txt: synchronisation with colour was not checked");
  if (fs::exists(folder / "groundtruth.txt"))
    recording.notes.push_back("groundtruth.txt was left out: a session knows no poses of a scan");
  for (auto& each : depth) recording.frames.push_back({{}, {}, std::move(each.path)});
  return recording;
}

const Importer::Variant tum_variant{"tum", tum};

}  // namespace
}  // namespace dressform
