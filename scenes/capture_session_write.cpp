#include <tbb/parallel_for.h>

#include "scenes/calibration_json.h"
#include "scenes/capture_session.h"
#include "scenes/folder_hash.h"
#include "scenes/image_file.h"
#include "scenes/json_file.h"
#include "scenes/picks.h"
#include "scenes/scan_poses.h"
#include "scenes/session_folder.h"
#include "scenes/session_layout.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct ImageFile {
  fs::path path;
  const cv::Mat* image;
};

ordered_json names_of(const CaptureSession& session, const std::map<std::string, Shot>& shots) {
  auto names = ordered_json::array();
  for (const auto& sensor : session.sensors)
    if (shots.count(sensor)) names.push_back(sensor);
  return names;
}

ordered_json session_json(const CaptureSession& session) {
  ordered_json json{
      {"format", session_layout::kFormat}, {"version", session_layout::kVersion}, {"name", session.name},
      {"created_by", session.created_by},  {"licence", session.licence},          {"sensors", session.sensors}};
  json["shots"] = {{"naked", names_of(session, session.naked)}, {"dressed", names_of(session, session.dressed)}};
  json["scans"] = ordered_json::object();
  for (const auto& [name, scan] : session.scans)
    json["scans"][name] = {{"sensor", scan.sensor}, {"frames", scan.depth_mm.size()}};
  if (session.boards) {
    const auto& boards = *session.boards;
    json["boards"] = {{"inner_corners", {boards.inner_corners_x, boards.inner_corners_y}},
                      {"square_m", boards.square_m},
                      {"views", boards.shots.empty() ? 0 : boards.shots.begin()->second.size()}};
  }
  if (session.prior) {
    json["world_from_sensor_prior"] = ordered_json::object();
    for (const auto& [name, pose] : session.prior->world_from_sensor)
      json["world_from_sensor_prior"][name] = to_json(pose);
    json["prior_sigma"] = {{"rotation_deg", session.prior->rotation_sigma_deg},
                           {"translation_m", session.prior->translation_sigma_m}};
  }
  return json;
}

void write_skeleton(const fs::path& file, const Skeleton& skeleton) {
  auto joints = ordered_json::object();
  for (const auto& name : joint_names()) {
    const auto joint = skeleton.find(name);
    if (joint != skeleton.end())
      joints[name] = {{"position", to_json(joint->second.position)}, {"tracked", joint->second.tracked}};
  }
  write_json(file, {{"joints", joints}});
}

void list_shots(const fs::path& folder, const std::map<std::string, Shot>& shots, std::vector<ImageFile>& files) {
  for (const auto& [sensor, shot] : shots) {
    fs::create_directories(folder / sensor);
    if (!shot.color.empty()) files.push_back({folder / sensor / "color.png", &shot.color});
    files.push_back({folder / sensor / "depth.png", &shot.depth_mm});
    if (!shot.ir.empty()) files.push_back({folder / sensor / "ir.png", &shot.ir});
    if (!shot.body_index.empty()) files.push_back({folder / sensor / "body_index.png", &shot.body_index});
    if (shot.skeleton) write_skeleton(folder / sensor / "skeleton.json", *shot.skeleton);
  }
}

void list_scan(const fs::path& folder, const DepthScan& scan, std::vector<ImageFile>& files) {
  fs::create_directories(folder);
  for (std::size_t i = 0; i < scan.depth_mm.size(); ++i)
    files.push_back({folder / session_layout::depth_frame(static_cast<int>(i)), &scan.depth_mm[i]});
}

void list_boards(const fs::path& folder, const Boards& boards, std::vector<ImageFile>& files) {
  for (const auto& [sensor, shots] : boards.shots) {
    fs::create_directories(folder / sensor);
    for (std::size_t i = 0; i < shots.size(); ++i) {
      const int index = static_cast<int>(i);
      files.push_back({folder / sensor / session_layout::board_image(index, "color"), &shots[i].color});
      files.push_back({folder / sensor / session_layout::board_image(index, "ir"), &shots[i].ir});
      files.push_back({folder / sensor / session_layout::board_image(index, "depth"), &shots[i].depth_mm});
    }
  }
}

}  // namespace

void finish_session(NewFolder& folder, const CaptureSession& outline) {
  if (outline.calibration) write_calibration(folder.temporary() / "calibration.json", *outline.calibration);
  for (const auto& [name, scan] : outline.scans)
    if (!scan.world_from_frame.empty())
      write_scan_poses(folder.temporary() / name / session_layout::kPoses, scan.world_from_frame);
  write_json(folder.temporary() / "session.json", session_json(outline));
  folder.keep();
}

void write_capture_session(const fs::path& folder, const CaptureSession& session) {
  NewFolder writer(folder);
  std::vector<ImageFile> files;
  list_shots(writer.temporary() / "naked", session.naked, files);
  list_shots(writer.temporary() / "dressed", session.dressed, files);
  for (const auto& [name, scan] : session.scans) list_scan(writer.temporary() / name, scan, files);
  if (session.boards) list_boards(writer.temporary() / "boards", *session.boards, files);
  tbb::parallel_for(std::size_t(0), files.size(), [&](std::size_t i) { write_png(files[i].path, *files[i].image); });
  finish_session(writer, session);
}

std::string session_content_hash(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder.string(), "is missing; expected the folder of a session");
  return hash_folder(folder, {"truth", kPicksFolder});
}

}  // namespace dressform
