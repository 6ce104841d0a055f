#include "scenes/import/stamped_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <tuple>

#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

bool is_image(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

// Number and, where there is one, time of a file's name.
struct NumberedName {
  double number = 0, time_s = 0;
  bool timed = false;
};
NumberedName numbered_name(const fs::path& path) {
  static const std::regex form("([0-9]{1,15})(-([0-9]{1,15}))?");
  std::smatch parts;
  const std::string stem = path.stem().string();
  if (!std::regex_match(stem, parts, form))
    throw InputError(path.string(), "found no number for a name; expected e.g. 00012.png or 0000013-000000400400.png");
  NumberedName name;
  name.number = std::stod(parts[1]);
  name.timed = parts[3].matched;
  if (name.timed) name.time_s = 1e-6 * std::stod(parts[3]);
  return name;
}

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

}  // namespace

NumberedFiles numbered_files(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder.string(), "is missing; expected a folder of images");
  std::vector<std::pair<NumberedName, fs::path>> named;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_image(entry.path()) && entry.path().filename().string()[0] != '.')
      named.push_back({numbered_name(entry.path()), entry.path()});
  std::sort(named.begin(), named.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first.number, a.second) < std::tie(b.first.number, b.second);
  });
  NumberedFiles result;
  result.timed = !named.empty() && named.front().first.timed;
  for (std::size_t i = 0; i < named.size(); ++i) {
    const auto& [name, path] = named[i];
    if (name.timed != result.timed)
      throw InputError(path.string(), "found names with and without a time; expected one kind in a folder");
    const double stamp_s = name.timed ? name.time_s : name.number;
    if (i > 0 && (name.number == named[i - 1].first.number || stamp_s <= result.files.back().stamp_s))
      throw InputError(path.string(), fmt::format("found a number or time that does not increase after {}; expected "
                                                  "frames in order",
                                                  named[i - 1].second.filename().string()));
    result.files.push_back({stamp_s, path});
  }
  return result;
}

std::vector<StampedFile> listed_files(const fs::path& folder, const std::string& name, double unit_s) {
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
    files.back().stamp_s *= unit_s;
    if (files.size() > 1 && files.back().stamp_s <= files[files.size() - 2].stamp_s)
      throw InputError(where, fmt::format("found stamp {:.6f} after {:.6f}; expected stamps that increase",
                                          files.back().stamp_s, files[files.size() - 2].stamp_s));
  }
  if (files.empty()) throw InputError(file.string(), "found no images; expected a line for each");
  return files;
}

std::vector<std::pair<int, int>> associate(const std::vector<StampedFile>& a, const std::vector<StampedFile>& b,
                                           double tolerance_s) {
  std::vector<std::tuple<double, int, int>> close;
  std::size_t from = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    while (from < b.size() && b[from].stamp_s < a[i].stamp_s - tolerance_s) ++from;
    for (std::size_t k = from; k < b.size() && b[k].stamp_s <= a[i].stamp_s + tolerance_s; ++k)
      close.emplace_back(std::abs(a[i].stamp_s - b[k].stamp_s), static_cast<int>(i), static_cast<int>(k));
  }
  std::sort(close.begin(), close.end());
  std::vector<bool> used_a(a.size()), used_b(b.size());
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [apart_s, i, k] : close) {
    if (used_a[i] || used_b[k]) continue;
    used_a[i] = used_b[k] = true;
    pairs.push_back({i, k});
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<DepthAndColor> with_partners(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& color,
                                         double tolerance_s, const std::string& where,
                                         std::vector<std::string>& notes) {
  const auto pairs = associate(depth, color, tolerance_s);
  const std::string near = tolerance_s > 0 ? fmt::format("colour frame within {:g} ms", 1000 * tolerance_s)
                                           : std::string("colour frame of the same number");
  if (2 * pairs.size() < depth.size())
    throw InputError(where, fmt::format("found {} of {} depth frames with a {}; expected synchronised streams, half of "
                                        "them at least",
                                        pairs.size(), depth.size(), near));
  if (pairs.size() < depth.size())
    notes.push_back(
        fmt::format("{} of {} depth frames left out: no {}", depth.size() - pairs.size(), depth.size(), near));
  std::vector<DepthAndColor> kept;
  for (const auto& pair : pairs) kept.push_back({depth[pair.first], color[pair.second]});
  return kept;
}

void set_stream(Recording& recording, const StreamParams& params) {
  recording.on_color_grid = true;
  recording.depth_per_m = params.depth_per_m;
  recording.depth_scale_option = "--set import.depth_per_m";
  recording.no_depth = {65535, params.no_depth};
}

void fail_without_infrared(const fs::path& recording) {
  throw InputError(recording.string(),
                   "found no infrared images, which this format does not know and boards are found in; expected --role "
                   "naked, dressed, scan_naked or scan_user");
}

}  // namespace dressform
