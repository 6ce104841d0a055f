#include "scenes/picks.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <set>

#include "scenes/capture_session.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/folder_hash.h"
#include "scenes/image_file.h"
#include "scenes/new_folder.h"
#include "scenes/pick_names.h"
#include "scenes/pick_points.h"
#include "scenes/pick_regions.h"
#include "scenes/session_limits.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kMostBody_m = 4;    // from the origin, which is on the floor below the body
constexpr double kMostDepth_m = 10;  // that depth cameras see
constexpr double kLeastDepth_m = 0.1;
constexpr std::size_t kMostFiles = 1000;
const std::set<std::string> kPointFiles{".pp", ".txt", ".csv", ".asc"};

// What is wrong with points for coordinates in metres in that frame; empty: nothing.
std::string problem_with_points(const std::string& frame, const std::vector<Vector3d>& points) {
  const bool body = frame == kModelFrame || frame == kUserFrame;
  const double most = body ? kMostBody_m : kMostDepth_m;
  const auto found = [](const Vector3d& point) {
    return fmt::format("found a point at ({:g}, {:g}, {:g})", point.x(), point.y(), point.z());
  };
  for (const Vector3d& point : points) {
    if (!(point.norm() <= most))
      return fmt::format("{}; expected metres, at most {:g} m from the origin{}", found(point), most,
                         unit_guess(point.norm(), 0.2, body ? 2.5 : 4));
    if (!body && point.z() < kLeastDepth_m)
      return fmt::format(
          "{}; expected points before the infrared camera \"{}\": x right, y down, z forward, metres "
          "(picked on the model? then they belong to picks/model)",
          found(point), frame);
  }
  return {};
}

class Reader {
 public:
  explicit Reader(const fs::path& session)
      : session_(session), root_(session / kPicksFolder), outline_(read_session_outline(session)) {}

  Picks read() {
    for (const auto& entry : entries_of(root_)) {
      const std::string name = entry.filename().string();
      if (!fs::is_directory(entry))
        read_region_file(entry);
      else if (is_sensor_frame(name) && !is_sensor(name))
        throw InputError(entry.string(),
                         "found a folder that is no frame; expected model, user, scan_naked, "
                         "scan_user or a sensor that session.json lists: " +
                             sensors_text());
      else
        read_frame(name, entry);
    }
    check_pairs();
    return std::move(picks_);
  }

 private:
  // Sorted; what begins with a dot is nobody's pick. A link must not lead out of the session.
  std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().filename().string()[0] == '.') continue;
      if (++files_ > kMostFiles)
        throw InputError(folder.string(), fmt::format("found more than {} files; expected picks", kMostFiles));
      const fs::path real = fs::weakly_canonical(entry.path()), root = fs::weakly_canonical(session_);
      if (std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
        throw InputError(entry.path().string(), "leads out of the session; expected a file in it");
      entries.push_back(entry.path());
    }
    std::sort(entries.begin(), entries.end());
    return entries;
  }

  bool is_sensor(const std::string& name) const {
    return std::count(outline_.sensors.begin(), outline_.sensors.end(), name) > 0;
  }

  std::string sensors_text() const {
    std::string text;
    for (const auto& sensor : outline_.sensors) text += (text.empty() ? "" : ", ") + sensor;
    return text;
  }

  void read_frame(const std::string& frame, const fs::path& folder) {
    for (const auto& file : entries_of(folder)) {
      const std::string extension = file.extension().string();
      if (kPointFiles.count(extension))
        read_points(frame, file);
      else if (extension == ".json" && is_sensor_frame(frame))
        read_labels(frame, file);
      else
        throw InputError(file.string(), std::string("found a file of another kind; expected points (.pp, .txt, .csv, "
                                                    ".asc)") +
                                            (is_sensor_frame(frame) ? " or labelme's shapes (.json)" : ""));
    }
  }

  void read_points(const std::string& frame, const fs::path& file) {
    const std::string where = file.string(), name = file.stem().string(), text = read_file_bytes(file, kMostPickBytes);
    for (const std::string& problem : {problem_with_points_name(name), problem_with_points_frame(name, frame)})
      if (!problem.empty()) throw InputError(where, problem);
    PickedPoints picked{frame,
                        file.extension() == ".pp" ? points_of_pick_points(where, text) : points_of_list(where, text)};
    if (static_cast<int>(picked.points.size()) < least_points(name))
      throw InputError(where,
                       fmt::format("found {} points; expected {} at least", picked.points.size(), least_points(name)));
    const std::string problem = problem_with_points(frame, picked.points);
    if (!problem.empty()) throw InputError(where, problem);
    auto& parts = picks_.points[name];
    for (const auto& part : parts)
      if (part.frame == frame) throw InputError(where, "found \"" + name + "\" twice in this frame; expected one file");
    parts.push_back(std::move(picked));
  }

  // All shapes of one sensor's image, each named by its label.
  void read_labels(const std::string& sensor, const fs::path& file) {
    for (const auto& [label, mask] : read_labelme(file, image_size(sensor, file))) {
      const auto full = region_name(label, {sensor});
      if (!full && !is_region_kind(label))
        throw InputError(file.string() + ": shapes",
                         "found a label \"" + label + "\"; expected one of " + known_region_kinds());
      keep(full ? full->text() : label + "_" + sensor, mask, file);
    }
  }

  // One region, named by the file.
  void read_region_file(const fs::path& file) {
    const auto name = region_name(file.stem().string(), outline_.sensors);
    const std::string extension = file.extension().string();
    if (!name || (extension != ".png" && extension != ".json"))
      throw InputError(file.string(),
                       "found a file that is no region; expected <region>_<sensor>.png or .json with a "
                       "region of " +
                           known_region_kinds() + " and a sensor of " + sensors_text() +
                           ", or points in the folder of a frame");
    const cv::Size size = image_size(name->sensor, file);
    if (extension == ".png") return keep(name->text(), read_mask(file, size), file);
    cv::Mat all(size, CV_8UC1, cv::Scalar(0));
    for (const auto& [label, mask] : read_labelme(file, size)) all |= mask;
    keep(name->text(), all, file);
  }

  void keep(const std::string& name, const cv::Mat& mask, const fs::path& file) {
    if (!picks_.regions.emplace(name, mask).second)
      throw InputError(file.string(), "found \"" + name + "\" twice; expected it in one file");
  }

  // Of the sensor's colour image, in which regions are drawn; looked up once for all regions of a sensor.
  cv::Size image_size(const std::string& sensor, const fs::path& file) {
    const auto known = image_sizes_.find(sensor);
    if (known != image_sizes_.end()) return known->second;
    return image_sizes_[sensor] = find_image_size(sensor, file);
  }

  cv::Size find_image_size(const std::string& sensor, const fs::path& file) const {
    if (outline_.calibration) {
      const auto& color = outline_.calibration->sensors.at(sensor).color;
      if (color) return {color->width, color->height};
      throw InputError(file.string(), "found a region of \"" + sensor + "\", which has no colour camera");
    }
    for (const char* shot : {"dressed", "naked"})
      for (const char* name : {"color.png", "color.jpg"}) {
        const fs::path image = session_ / shot / sensor / name;
        if (fs::exists(image)) return read_image(image, kColorImage).size();
      }
    throw InputError(file.string(), "found a region of \"" + sensor + "\", which has no colour image");
  }

  void check_pairs() const {
    std::size_t counts[2] = {0, 0};
    for (const int which : {0, 1}) {
      const auto found = picks_.points.find(which == 0 ? "control" : "target");
      if (found == picks_.points.end()) continue;
      for (const auto& part : found->second) counts[which] += part.points.size();
    }
    if (counts[0] != counts[1])
      throw InputError(root_.string(),
                       fmt::format("found {} points named control and {} named target; expected as many of the one as "
                                   "of the other, in the same order",
                                   counts[0], counts[1]));
  }

  fs::path session_, root_;
  CaptureSession outline_;
  Picks picks_;
  std::map<std::string, cv::Size> image_sizes_;  // by sensor
  std::size_t files_ = 0;
};

}  // namespace

std::vector<std::string> Picks::names() const {
  std::vector<std::string> result;
  for (const auto& [name, parts] : points) result.push_back(name);
  for (const auto& [name, region] : regions) result.push_back(name);
  return result;
}

cv::Mat picked_region(const Picks& picks, const std::string& name, const cv::Size& size) {
  const auto found = picks.regions.find(name);
  if (found == picks.regions.end()) return {};
  const cv::Mat& region = found->second;
  if (region.size() != size)
    throw InputError("picks: " + name, fmt::format("is {} x {}; expected the colour image's size, {} x {}", region.cols,
                                                   region.rows, size.width, size.height));
  return region;
}

std::optional<Picks> read_picks(const fs::path& session) {
  if (!fs::exists(session / kPicksFolder)) return {};
  if (!fs::is_directory(session / kPicksFolder))
    throw InputError((session / kPicksFolder).string(), "found a file; expected a folder");
  return Reader(session).read();
}

void write_picks(const fs::path& session, const Picks& picks) {
  NewFolder folder(session / kPicksFolder);
  for (const auto& [name, parts] : picks.points)
    for (const auto& part : parts) {
      fs::create_directories(folder.temporary() / part.frame);
      write_file_atomically(folder.temporary() / part.frame / (name + ".pp"), pick_points_text(part.points));
    }
  const std::vector<std::pair<std::string, cv::Mat>> regions(picks.regions.begin(), picks.regions.end());
  tbb::parallel_for(std::size_t{0}, regions.size(), [&](std::size_t i) {
    write_png(folder.temporary() / (regions[i].first + ".png"), regions[i].second);
  });
  folder.keep();
}

std::string picks_content_hash(const fs::path& session) { return hash_folder(session / kPicksFolder); }

}  // namespace dressform
