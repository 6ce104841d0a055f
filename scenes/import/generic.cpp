#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <tuple>

#include "scenes/calibration_toml.h"
#include "scenes/error.h"
#include "scenes/import/import.h"
#include "scenes/import/stamped_files.h"
#include "scenes/session_limits.h"

// Any recording that is a folder of images, as a layout in TOML describes it (scenes/README.md, "Recordings of other
// tools"): RealSense and Orbbec exports, libfreenect2, ROS bags as image folders, unpacked .sens files of ScanNet.
namespace dressform {
namespace {

namespace fs = std::filesystem;

struct GenericParams {
  std::string layout;
};
template <class V>
void fields(V& v, GenericParams& p) {
  v("layout", p.layout, {}, "TOML file that says where the images are and what they mean");
}

// One stream of images: a pattern with {frame} or {stamp}, or a list of stamps and paths.
struct Stream {
  std::string files, list;
  bool there() const { return !files.empty() || !list.empty(); }
};

struct Layout {
  Stream depth, color, ir;
  double per_m = 1000, unit_s = 1, tolerance_ms = 20;
  std::vector<int> no_depth{65535};
  DepthRange range;
  bool depth_on_color_grid = false;
  std::string role, sensor;
  std::optional<SensorCalibration> calibration;
};

void read_no_depth(TomlSection& section, std::vector<int>& codes) {
  const auto* node = section.find("no_depth");
  if (!node) return;
  const auto* array = node->as_array();
  if (!array) section.fail("no_depth", "expected whole numbers in brackets, e.g. [4095]");
  for (const auto& element : *array) {
    const auto code = element.value_exact<std::int64_t>();
    if (!code || *code < 0 || *code > 65535) section.fail("no_depth", "expected whole numbers from 0 to 65535");
    codes.push_back(static_cast<int>(*code));
  }
}

void read_stream(TomlSection& section, Stream& stream) {
  section("files", stream.files, {}, "");
  section("list", stream.list, {}, "");
  if (stream.files.empty() == stream.list.empty())
    section.fail("",
                 "expected either `files`, a pattern such as \"depth/{frame}.png\", or `list`, a text file of stamps "
                 "and paths");
}

Layout read_layout(const fs::path& file) {
  TomlFiles files;
  TomlSection top(files, files.open(file, file.string(), "--layout"), "");
  Layout layout;
  top.child("depth", [&](TomlSection& depth) {
    read_stream(depth, layout.depth);
    depth("per_m", layout.per_m, 1.0, 1e5, "1/m", "");
    depth("nearest_m", layout.range.nearest_m, 0.01, 10.0, "m", "");
    depth("farthest_m", layout.range.farthest_m, 0.1, 60.0, "m", "");
    depth("on_color_grid", layout.depth_on_color_grid, "");
    read_no_depth(depth, layout.no_depth);
  });
  if (!layout.depth.there()) throw InputError(file.string(), "found no [depth]; expected where its images are");
  top.child("color", [&](TomlSection& color) { read_stream(color, layout.color); });
  top.child("ir", [&](TomlSection& ir) { read_stream(ir, layout.ir); });
  top.child("stamps", [&](TomlSection& stamps) {
    stamps("unit_s", layout.unit_s, 1e-12, 1e3, "s", "");
    stamps("tolerance_ms", layout.tolerance_ms, 0.0, 1000.0, "ms", "");
  });
  top.child("calibration", [&](TomlSection& section) {
    layout.calibration = read_calibration(section);
    if (const auto found = problem_with(*layout.calibration)) section.fail("", found->field + ": " + found->problem);
  });
  top("role", layout.role, {"boards", "naked", "dressed", "scan_naked", "scan_user"}, "");
  top("sensor", layout.sensor, {}, "");
  top.finish();
  return layout;
}

// A pattern as a regular expression whose one group is the number, and whether that is a time.
struct Pattern {
  std::regex form;
  bool timed = false;
  fs::path folder;  // that all its files are in, relative
  int depth = 0;    // folders below it
};

Pattern pattern_of(const std::string& text, const std::string& where) {
  const fs::path path = fs::path(text).lexically_normal();
  const std::string frame = "{frame}", stamp = "{stamp}";
  const bool has_frame = text.find(frame) != text.npos, has_stamp = text.find(stamp) != text.npos;
  if (has_frame == has_stamp || text.size() > 200 || path.is_absolute() || *path.begin() == "..")
    throw InputError(where, "found \"" + text.substr(0, 200) +
                                "\"; expected a path inside the recording with one {frame} or one {stamp}");
  Pattern pattern;
  pattern.timed = has_stamp;
  std::string form;
  for (std::size_t i = 0; i < text.size();) {
    const std::string& mark = has_frame ? frame : stamp;
    if (text.compare(i, mark.size(), mark) == 0) {
      form += has_frame ? "0*([0-9]{1,15})" : "([0-9]{1,20}(?:\\.[0-9]{1,20})?)";
      i += mark.size();
    } else if (text[i] == '*') {
      form += "[^/]*", ++i;
    } else {
      if (!std::isalnum(static_cast<unsigned char>(text[i])) && text[i] != '/' && text[i] != '_') form += '\\';
      form += text[i++];
    }
  }
  pattern.form = std::regex(form);
  for (const auto& part : path.parent_path()) {
    if (pattern.depth > 0 || part.string().find_first_of("{*") != std::string::npos)
      ++pattern.depth;
    else
      pattern.folder /= part;
  }
  return pattern;
}

struct FoundStream {
  std::vector<StampedFile> files;
  bool timed = false;
};

void sort_and_check(std::vector<StampedFile>& files, const std::string& what) {
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return std::tie(a.stamp_s, a.path) < std::tie(b.stamp_s, b.path); });
  for (std::size_t i = 1; i < files.size(); ++i)
    if (files[i].stamp_s == files[i - 1].stamp_s)
      throw InputError(files[i].path.string(), "found the same number as of " + files[i - 1].path.string() +
                                                   "; expected one " + what + " image of each");
}

FoundStream find_stream(const fs::path& recording, const Stream& stream, const Layout& layout,
                        const std::string& layout_file, const std::string& what) {
  if (!stream.list.empty()) return {listed_files(recording, stream.list, layout.unit_s), true};
  const std::string where = layout_file + ": " + what + ".files";
  const Pattern pattern = pattern_of(stream.files, where);
  const fs::path folder = recording / pattern.folder;
  if (!fs::is_directory(folder)) throw InputError(folder.string(), "is missing; expected the folder of " + what);
  FoundStream found{{}, pattern.timed};
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->is_directory() && entry.depth() >= pattern.depth) entry.disable_recursion_pending();
    std::smatch parts;
    const std::string name = entry->path().lexically_relative(recording).generic_string();
    if (name.size() > 1000 || !entry->is_regular_file() || !std::regex_match(name, parts, pattern.form)) continue;
    found.files.push_back({std::stod(parts[1]) * (pattern.timed ? layout.unit_s : 1), entry->path()});
  }
  if (found.files.empty())
    throw InputError(where, "found no file like \"" + stream.files + "\" in " + recording.string() + "; expected some");
  sort_and_check(found.files, what);
  return found;
}

void add_stream(Recording& recording, std::vector<StampedFile>& depth, bool timed, const FoundStream& stream,
                const Layout& layout, const std::string& what, fs::path RecordedFrame::*image) {
  if (stream.timed != timed)
    throw InputError(what + ".files",
                     "found {frame} in one stream and {stamp} or a list in another; expected the same "
                     "kind in all");
  const auto pairs = associate(depth, stream.files, timed ? 1e-3 * layout.tolerance_ms : 0);
  if (2 * pairs.size() < depth.size())
    throw InputError(what + " images", fmt::format("found partners for {} of {} depth frames; expected half of them at "
                                                   "least (stamps.unit_s and stamps.tolerance_ms say how stamps count)",
                                                   pairs.size(), depth.size()));
  if (pairs.size() < depth.size())
    recording.notes.push_back(fmt::format("{} of {} depth frames left out: no {} image of the same moment",
                                          depth.size() - pairs.size(), depth.size(), what));
  std::vector<RecordedFrame> frames;
  std::vector<StampedFile> kept;
  for (const auto& [a, b] : pairs) {
    frames.push_back(recording.frames[a]);
    frames.back().*image = stream.files[b].path;
    kept.push_back(depth[a]);
  }
  recording.frames = std::move(frames);
  depth = std::move(kept);
}

Recording generic(const fs::path& folder, const RecordingUse&, const GenericParams& params) {
  if (params.layout.empty()) throw InputError("--layout", "is missing; expected a TOML file that describes the folder");
  if (!fs::is_directory(folder)) throw InputError(folder.string(), "is missing; expected the folder of a recording");
  const Layout layout = read_layout(params.layout);
  Recording recording;
  recording.role = layout.role, recording.sensor_name = layout.sensor;
  recording.sensor.model = "unknown";
  if (layout.calibration) recording.sensor = *layout.calibration, recording.calibrated = true;
  recording.on_color_grid = layout.depth_on_color_grid;
  recording.depth_per_m = layout.per_m;
  recording.depth_scale_option = "depth.per_m of the layout";
  recording.no_depth = layout.no_depth;
  recording.range = layout.range;
  FoundStream depth = find_stream(folder, layout.depth, layout, params.layout, "depth");
  for (const auto& each : depth.files) recording.frames.push_back({{}, {}, each.path});
  if (layout.color.there())
    add_stream(recording, depth.files, depth.timed, find_stream(folder, layout.color, layout, params.layout, "color"),
               layout, "color", &RecordedFrame::color);
  if (layout.ir.there())
    add_stream(recording, depth.files, depth.timed, find_stream(folder, layout.ir, layout, params.layout, "ir"), layout,
               "ir", &RecordedFrame::ir);
  return recording;
}

const Importer::Variant generic_variant{"generic", generic};

}  // namespace
}  // namespace dressform
