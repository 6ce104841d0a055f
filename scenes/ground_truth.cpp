#include "scenes/ground_truth.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <fstream>
#include <opencv2/core.hpp>

#include "scenes/calibration_json.h"
#include "scenes/error.h"
#include "scenes/image_file.h"
#include "scenes/json_file.h"
#include "scenes/mesh_io.h"
#include "scenes/new_folder.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

const std::vector<std::string> kSlots{"top", "bottom"};
const std::vector<std::string> kScans{"scan_naked", "scan_user"};
constexpr int kLabels = 4;            // 0 none, 1 skin, 2 top, 3 bottom
constexpr double kMostStrain = 0.05;  // of 95 % of the edges of cloth that lies as cloth does

void read_poses(const fs::path& folder, GroundTruth& truth) {
  if (!fs::exists(folder / "world_from_sensor.json")) return;
  const JsonValue file = read_json(folder / "world_from_sensor.json");
  const JsonValue sensors = file.at("sensors");
  for (const auto& name : sensors.names()) truth.world_from_sensor[name] = sensors.at(name).rigid();
  for (const auto& scan : kScans) {
    if (!file.has(scan)) continue;
    for (const auto& pose : file.at(scan).elements()) truth.scan_world_from_sensor[scan].push_back(pose.rigid());
  }
}

void write_poses(const fs::path& folder, const GroundTruth& truth) {
  ordered_json file{{"sensors", ordered_json::object()}};
  for (const auto& [name, pose] : truth.world_from_sensor) file["sensors"][name] = to_json(pose);
  for (const auto& [scan, poses] : truth.scan_world_from_sensor) {
    file[scan] = ordered_json::array();
    for (const auto& pose : poses) file[scan].push_back(to_json(pose));
  }
  write_json(folder / "world_from_sensor.json", file);
}

TruthRim read_rim(const JsonValue& value) {
  TruthRim rim;
  rim.name = value.at("name").text();
  rim.visible = value.at("visible").number(0, 1);
  for (const auto& point : value.at("points").elements()) rim.points.push_back(point.vector3());
  if (rim.points.size() < 3)
    value.at("points").fail("found " + std::to_string(rim.points.size()) + " points; expected a closed line");
  return rim;
}

void read_rims(const fs::path& folder, GroundTruth& truth) {
  if (!fs::exists(folder / "rims.json")) return;
  const JsonValue file = read_json(folder / "rims.json");
  for (const auto& [slot, garment] : truth.garments)
    for (const auto& rim : file.at(slot).elements()) truth.rims[slot].push_back(read_rim(rim));
}

void write_rims(const fs::path& folder, const GroundTruth& truth) {
  auto file = ordered_json::object();
  for (const auto& [slot, rims] : truth.rims) {
    file[slot] = ordered_json::array();
    for (const auto& rim : rims) {
      auto points = ordered_json::array();
      for (const auto& point : rim.points) points.push_back(to_json(point));
      file[slot].push_back({{"name", rim.name}, {"visible", rim.visible}, {"points", points}});
    }
  }
  write_json(folder / "rims.json", file);
}

TruthGarment read_garment(const fs::path& ply, const fs::path& glb) {
  TruthGarment garment;
  tbb::parallel_invoke([&] { garment.mesh = read_mesh(ply); },
                       [&] {
                         if (fs::exists(glb)) garment.textured = read_textured_mesh(glb);
                       });
  const auto views = find_ply_vertex_property(ply, "views");
  if (!views) return garment;
  garment.views = *views;
  if (garment.views.size() != garment.mesh.vertices.size())
    throw InputError(ply.string() + ": views", "found " + std::to_string(garment.views.size()) + " values; expected " +
                                                   std::to_string(garment.mesh.vertices.size()));
  return garment;
}

ClothRest read_rest(const JsonValue& value) {
  return {value.at("settled").flag(), value.at("speed_m_per_s").number(), value.at("strain_p95").number()};
}

void read_garments(const fs::path& folder, GroundTruth& truth) {
  for (const auto& slot : kSlots) {
    const fs::path ply = folder / (slot + ".ply");
    if (fs::exists(ply)) truth.garments[slot] = read_garment(ply, folder / (slot + ".glb"));
  }
  if (fs::exists(folder / "rest.json")) {  // sessions of before have none
    const JsonValue file = read_json(folder / "rest.json");
    for (auto& [slot, garment] : truth.garments) garment.rest = read_rest(file.at(slot));
  }
}

void write_garments(const fs::path& folder, const GroundTruth& truth) {
  fs::create_directories(folder);
  auto rest = ordered_json::object();
  for (const auto& [slot, garment] : truth.garments) {
    rest[slot] = {{"settled", garment.rest.settled},
                  {"speed_m_per_s", garment.rest.speed_m_per_s},
                  {"strain_p95", garment.rest.strain_p95}};
    PlyExtras extras;
    extras.vertex_properties["views"] = garment.views;
    write_ply(folder / (slot + ".ply"), garment.mesh, extras);
    write_glb(folder / (slot + ".glb"), garment.textured);
  }
  write_json(folder / "rest.json", rest);
}

void read_labels(const fs::path& folder, GroundTruth& truth) {
  for (const auto& [sensor, pose] : truth.world_from_sensor) {
    const fs::path file = folder / (sensor + ".png");
    if (!fs::exists(file)) continue;  // a sensor without a colour camera, or without a dressed shot
    truth.labels[sensor] = read_image(file, kIndexImage);
    double maximum = 0;
    cv::minMaxIdx(truth.labels[sensor], nullptr, &maximum);
    if (maximum >= kLabels)
      throw InputError(file.string(), "found label " + std::to_string(int(maximum)) + "; expected 0 to 3");
  }
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_all(const fs::path& folder, const GroundTruth& truth) {
  write_poses(folder, truth);
  if (truth.calibration) write_calibration(folder / "calibration.json", *truth.calibration);
  tbb::parallel_invoke([&] { write_ply(folder / "naked_body.ply", truth.naked_body); },
                       [&] { write_ply(folder / "user_body.ply", truth.user_body); },
                       [&] { write_garments(folder / "garments", truth); },
                       [&] {
                         fs::create_directories(folder / "labels");
                         for (const auto& [sensor, image] : truth.labels)
                           write_png(folder / "labels" / (sensor + ".png"), image);
                       });
  write_rims(folder, truth);
  std::ofstream scene(folder / "scene.toml", std::ios::binary);
  scene << truth.scene_toml;
  if (!scene.flush()) throw InputError((folder / "scene.toml").string(), "cannot be written");
}

}  // namespace

std::vector<std::string> drape_warnings(const fs::path& session_folder) {
  const fs::path file = session_folder / "truth/garments/rest.json";
  std::vector<std::string> lines;
  if (!fs::exists(file)) return lines;
  const JsonValue slots = read_json(file);
  for (const auto& slot : kSlots) {
    if (!slots.has(slot)) continue;
    const ClothRest rest = read_rest(slots.at(slot));
    if (!rest.settled)
      lines.push_back(fmt::format("{}: the cloth did not come to rest, it still moves at {:.0f} mm/s", slot,
                                  1e3 * rest.speed_m_per_s));
    if (rest.strain_p95 > kMostStrain)
      lines.push_back(
          fmt::format("{}: the cloth is stretched by up to {:.1f} % in 95 % of its edges; expected {:.0f} %", slot,
                      1e2 * rest.strain_p95, 1e2 * kMostStrain));
  }
  return lines;
}

std::vector<std::string> truth_garment_names(const fs::path& session_folder) {
  std::vector<std::string> names;
  for (const auto& slot : kSlots)
    if (fs::exists(session_folder / "truth/garments" / (slot + ".ply"))) names.push_back(slot);
  std::sort(names.begin(), names.end());
  return names;
}

bool ground_truth_exists(const fs::path& session_folder) { return fs::is_directory(session_folder / "truth"); }

GroundTruth read_ground_truth(const fs::path& session_folder) {
  const fs::path folder = session_folder / "truth";
  if (!fs::is_directory(folder)) throw InputError(folder.string(), "is missing; only synthetic sessions have truth");
  GroundTruth truth;
  read_poses(folder, truth);
  if (fs::exists(folder / "calibration.json")) truth.calibration = read_calibration(folder / "calibration.json");
  const auto body = [&](const char* name, Mesh& mesh) {
    if (fs::exists(folder / name)) mesh = read_mesh(folder / name);
  };
  tbb::parallel_invoke([&] { body("naked_body.ply", truth.naked_body); },
                       [&] { body("user_body.ply", truth.user_body); },
                       [&] { read_garments(folder / "garments", truth); });
  if (truth.world_from_sensor.empty() && truth.garments.empty() && truth.naked_body.triangles.empty())
    throw InputError(folder.string(),
                     "found neither poses nor garments nor bodies; expected world_from_sensor.json, "
                     "garments/<top|bottom>.ply or naked_body.ply");
  read_rims(folder, truth);
  read_labels(folder / "labels", truth);
  truth.scene_toml = read_text(folder / "scene.toml");
  return truth;
}

void write_ground_truth(const fs::path& session_folder, const GroundTruth& truth) {
  NewFolder folder(session_folder / "truth");
  write_all(folder.temporary(), truth);
  folder.keep();
}

}  // namespace dressform
