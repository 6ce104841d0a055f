#include <tbb/parallel_for.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <mutex>

#include "scenes/calibration_json.h"
#include "scenes/capture_session.h"
#include "scenes/image_file.h"
#include "scenes/json_file.h"
#include "scenes/scan_poses.h"
#include "scenes/session_depth.h"
#include "scenes/session_layout.h"
#include "scenes/session_limits.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// Names become folders: none may lead out of the session.
std::string safe_name(const JsonValue& value) {
  const std::string name = value.text();
  if (!is_sensor_name(name)) value.fail("found \"" + name + "\"; expected letters, digits, _, - and . (not first)");
  return name;
}

std::vector<std::string> safe_names(const JsonValue& value) {
  std::vector<std::string> names;
  for (const auto& element : value.elements()) {
    names.push_back(safe_name(element));
    if (std::count(names.begin(), names.end(), names.back()) > 1)
      element.fail("found \"" + names.back() + "\" twice; expected different names");
  }
  return names;
}

// Depth images that are judged together: those of one shot or scan.
struct DepthGroup {
  fs::path where;
  DepthTally tally;
  std::mutex mutex;
};

// Reads one session: first all that JSON says, which lists the images to read, then the images side by side.
class Reader {
 public:
  explicit Reader(const fs::path& folder) : folder_(folder) {
    if (!fs::is_directory(folder)) throw InputError(folder.string(), "is missing; expected the folder of a session");
    root_ = fs::canonical(folder);
  }

  CaptureSession read(bool with_images) {
    const JsonValue file = read_json(inside("session.json"), session_layout::kFormat, session_layout::kVersion);
    session_.name = file.at("name").text();
    if (file.has("created_by")) session_.created_by = file.at("created_by").text();
    if (file.has("licence")) session_.licence = file.at("licence").text();
    session_.sensors = safe_names(file.at("sensors"));
    if (session_.sensors.empty()) file.at("sensors").fail("found none; expected at least one sensor");
    read_boards(file);
    read_calibrations();
    read_prior(file);
    read_shots(file.at("shots"), "naked", session_.naked);
    read_shots(file.at("shots"), "dressed", session_.dressed);
    read_scans(file.at("scans"));
    if (with_images) decode();
    return std::move(session_);
  }

 private:
  // A file of the session; also a symbolic link must not lead out of it.
  fs::path inside(const fs::path& relative) const {
    const fs::path path = folder_ / relative;
    const fs::path real = fs::weakly_canonical(path);
    const auto [root_end, rest] = std::mismatch(root_.begin(), root_.end(), real.begin(), real.end());
    if (root_end != root_.end()) throw InputError(path.string(), "leads out of the session; expected a file in it");
    return path;
  }

  void known_sensor(const JsonValue& where, const std::string& name) const {
    if (std::count(session_.sensors.begin(), session_.sensors.end(), name) == 0)
      where.fail("found \"" + name + "\"; expected names that `sensors` lists");
  }

  void read_calibrations() {
    const fs::path file = inside("calibration.json");
    if (!fs::exists(file) && session_.boards) return;
    session_.calibration = read_calibration(file);
    for (const auto& sensor : session_.sensors)
      if (!session_.calibration->sensors.count(sensor))
        throw InputError(file.string() + ": sensors." + sensor, "is missing; session.json lists this sensor");
  }

  void read_prior(const JsonValue& file) {
    if (!file.has("world_from_sensor_prior")) return;
    RigPrior prior;
    const JsonValue poses = file.at("world_from_sensor_prior");
    for (const auto& name : poses.names()) {
      known_sensor(poses, name);
      prior.world_from_sensor[name] = poses.at(name).rigid();
    }
    prior.rotation_sigma_deg = file.at("prior_sigma").at("rotation_deg").number(0, 180);
    prior.translation_sigma_m = file.at("prior_sigma").at("translation_m").number(0, 1e6);
    if (const auto found = problem_with_prior(prior))
      (found->field.empty() ? poses : poses.at(found->field)).fail(found->problem);
    session_.prior = prior;
  }

  void read_shots(const JsonValue& shots, const std::string& which, std::map<std::string, Shot>& result) {
    const JsonValue list = shots.at(which);
    for (const auto& sensor : safe_names(list)) {
      known_sensor(list, sensor);
      const fs::path folder = fs::path(which) / sensor;
      Shot& shot = result[sensor];
      if (has_color(sensor)) image(color_file(folder), kColorImage, shot.color, size_of(sensor, true));
      depth(folder / "depth.png", shot.depth_mm, size_of(sensor, false), &group(folder / "depth.png"));
      if (fs::exists(inside(folder / "ir.png"))) image(folder / "ir.png", kDepthImage, shot.ir, size_of(sensor, false));
      if (fs::exists(inside(folder / "body_index.png")))
        image(folder / "body_index.png", kIndexImage, shot.body_index, size_of(sensor, false));
      if (fs::exists(inside(folder / "skeleton.json"))) shot.skeleton = read_skeleton(folder / "skeleton.json");
    }
  }

  bool has_color(const std::string& sensor) const {
    return !session_.calibration || session_.calibration->sensors.at(sensor).color;
  }

  // 0 x 0 where boards stand in for a calibration: any size, which then has to be the same in all images of the sensor.
  cv::Size size_of(const std::string& sensor, bool color) const {
    if (!session_.calibration) return {};
    const auto& calibration = session_.calibration->sensors.at(sensor);
    const Camera& camera = color ? *calibration.color : calibration.ir;
    return {camera.width, camera.height};
  }

  fs::path color_file(const fs::path& folder) const {
    const bool png = fs::exists(inside(folder / "color.png")), jpg = fs::exists(inside(folder / "color.jpg"));
    if (png && jpg)
      throw InputError((folder_ / folder).string(), "found color.png and color.jpg; expected one of them");
    return folder / (jpg ? "color.jpg" : "color.png");
  }

  Skeleton read_skeleton(const fs::path& relative) const {
    const JsonValue joints = read_json(inside(relative)).at("joints");
    Skeleton skeleton;
    for (const auto& name : joints.names()) {
      if (std::count(joint_names().begin(), joint_names().end(), name) == 0)
        joints.at(name).fail("found an unknown joint; expected the SDK's 25 names");
      skeleton[name] = {joints.at(name).at("position").vector3(), joints.at(name).at("tracked").flag()};
    }
    return skeleton;
  }

  void read_scans(const JsonValue& scans) {
    for (const auto& name : session_layout::kScans) {
      if (!scans.has(name)) continue;
      const JsonValue entry = scans.at(name);
      DepthScan& scan = session_.scans[name];
      scan.sensor = safe_name(entry.at("sensor"));
      if (session_.calibration && !session_.calibration->sensors.count(scan.sensor))
        entry.at("sensor").fail("found \"" + scan.sensor + "\"; expected a sensor of calibration.json");
      scan.depth_mm.resize(entry.at("frames").whole(1, session_layout::kMostFrames));
      DepthGroup& frames = group(name);
      for (std::size_t i = 0; i < scan.depth_mm.size(); ++i)
        depth(fs::path(name) / session_layout::depth_frame(static_cast<int>(i)), scan.depth_mm[i],
              size_of(scan.sensor, false), &frames);
      check_no_further_frames(entry.at("frames"), name, scan.depth_mm.size());
      const fs::path poses = inside(fs::path(name) / session_layout::kPoses);
      if (fs::exists(poses)) scan.world_from_frame = read_scan_poses(poses, scan.depth_mm.size());
    }
  }

  void check_no_further_frames(const JsonValue& frames, const std::string& scan, std::size_t count) const {
    const fs::path folder = inside(scan);
    std::size_t found = 0;
    if (fs::is_directory(folder))
      for (const auto& entry : fs::directory_iterator(folder))
        found += entry.path().filename().string().find("_depth.png") != std::string::npos;
    if (found > count)
      frames.fail("found " + std::to_string(found) + " frames in " + folder.string() + "; expected " +
                  std::to_string(count));
  }

  void read_boards(const JsonValue& file) {
    if (!file.has("boards")) return;
    const JsonValue value = file.at("boards");
    const auto corners = value.at("inner_corners").elements();
    if (corners.size() != 2) value.at("inner_corners").fail("expected two numbers");
    Boards& boards = session_.boards.emplace();
    boards.inner_corners_x = corners[0].whole(2, 200);
    boards.inner_corners_y = corners[1].whole(2, 200);
    boards.square_m = value.at("square_m").number();
    const std::string problem = problem_with_board(boards.inner_corners_x, boards.inner_corners_y, boards.square_m);
    if (!problem.empty()) value.at("square_m").fail(problem);
    const int views = value.at("views").whole(1, session_layout::kMostFrames);
    for (const auto& sensor : session_.sensors) boards.shots[sensor].resize(views);
    for (auto& [sensor, shots] : boards.shots)
      for (int i = 0; i < views; ++i) {
        const fs::path folder = fs::path("boards") / sensor;
        image(folder / session_layout::board_image(i, "color"), kColorImage, shots[i].color, {});
        image(folder / session_layout::board_image(i, "ir"), kDepthImage, shots[i].ir, {});
        depth(folder / session_layout::board_image(i, "depth"), shots[i].depth_mm, {}, nullptr);
      }
  }

  void image(const fs::path& relative, const ImageKind& kind, cv::Mat& target, cv::Size size) {
    jobs_.push_back([path = inside(relative), &kind, &target, size] { target = read_image(path, kind, size); });
    targets_.push_back({&target, inside(relative)});
  }

  DepthGroup& group(const fs::path& relative) {
    groups_.emplace_back().where = inside(relative);
    return groups_.back();
  }

  // A depth image, which must say 0 where there is no depth; counted into its group.
  void depth(const fs::path& relative, cv::Mat& target, cv::Size size, DepthGroup* group) {
    jobs_.push_back([path = inside(relative), &target, size, group] {
      target = read_image(path, kDepthImage, size);
      const std::string problem = problem_with_depth_code(target);
      if (!problem.empty()) throw InputError(path.string(), problem);
      if (!group) return;
      DepthTally tally;
      tally.add(target);
      const std::lock_guard lock(group->mutex);
      group->tally.add(tally);
    });
    targets_.push_back({&target, inside(relative)});
  }

  void check_depths() const {
    for (const auto& group : groups_) {
      const std::string problem = problem_with_depth(group.tally);
      if (!problem.empty()) throw InputError(group.where.string(), problem);
    }
  }

  // All images, two at a time or more; of several damaged ones the first in the session's order is reported.
  void decode() {
    std::vector<std::exception_ptr> errors(jobs_.size());
    tbb::parallel_for(std::size_t(0), jobs_.size(), [&](std::size_t i) {
      try {
        jobs_[i]();
      } catch (...) {
        errors[i] = std::current_exception();
      }
    });
    for (const auto& error : errors)
      if (error) std::rethrow_exception(error);
    check_depths();
    if (!session_.calibration) check_sizes_agree();
  }

  // Without a calibration: depth and IR of one sensor share one grid in every image.
  void check_sizes_agree() const {
    std::map<std::string, cv::Size> grids;
    const auto check = [&](const std::string& sensor, const cv::Mat& image) {
      const auto [grid, first] = grids.emplace(sensor, image.size());
      if (grid->second == image.size()) return;
      for (const auto& [target, path] : targets_)
        if (target->data == image.data)
          throw InputError(path.string(), "differs in size from the sensor's other images");
    };
    for (const auto* shots : {&session_.naked, &session_.dressed})
      for (const auto& [sensor, shot] : *shots) {
        for (const auto* image : {&shot.depth_mm, &shot.ir, &shot.body_index})
          if (!image->empty()) check(sensor, *image);
        check(sensor + " colour", shot.color);
      }
    for (const auto& [sensor, shots] : session_.boards->shots)
      for (const auto& shot : shots) {
        for (const auto* image : {&shot.ir, &shot.depth_mm}) check(sensor, *image);
        check(sensor + " colour", shot.color);
      }
    for (const auto& [name, scan] : session_.scans)
      for (const auto& frame : scan.depth_mm) check(scan.sensor, frame);
  }

  fs::path folder_, root_;
  CaptureSession session_;
  std::vector<std::function<void()>> jobs_;
  std::vector<std::pair<const cv::Mat*, fs::path>> targets_;
  std::deque<DepthGroup> groups_;
};

}  // namespace

bool is_sensor_name(const std::string& name) {
  const char* allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  return !name.empty() && name[0] != '.' && name.size() <= 100 && name.find_first_not_of(allowed) == name.npos;
}

CaptureSession read_capture_session(const fs::path& folder) { return Reader(folder).read(true); }

CaptureSession read_session_outline(const fs::path& folder) { return Reader(folder).read(false); }

}  // namespace dressform
