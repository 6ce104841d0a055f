#include "eval/score/run_outputs.h"

#include <tbb/parallel_for_each.h>

#include <functional>
#include <vector>

#include "eval/score/mesh_bounds.h"
#include "scenes/calibration_json.h"
#include "scenes/image_file.h"
#include "scenes/json_file.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

void read_registration(const fs::path& file, RunOutputs& outputs) {
  const JsonValue json = read_json(file);
  const JsonValue poses = json.at("model_from_sensor"), converged = json.at("converged");
  for (const auto& name : poses.names()) outputs.model_from_sensor[name] = poses.at(name).rigid();
  for (const auto& name : converged.names()) outputs.converged[name] = converged.at(name).flag();
  if (json.has("user_model_from_frame0")) outputs.user_model_from_frame0 = json.at("user_model_from_frame0").rigid();
}

void read_calibrated(const fs::path& file, RunOutputs& outputs) {
  if (!fs::exists(file)) return;
  outputs.calibration = read_calibration(file);
  const JsonValue json = read_json(file);
  if (!json.has("boards")) return;
  const JsonValue boards = json.at("boards");
  for (const auto& sensor : boards.names())
    outputs.boards[sensor] = {boards.at(sensor).at("ir_rms_px").number(0),
                              boards.at(sensor).at("color_rms_px").number(0)};
}

void read_labels(const fs::path& folder, RunOutputs& outputs) {
  if (!fs::is_directory(folder)) return;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png")
      outputs.labels[entry.path().stem().string()] = read_image(entry.path(), kIndexImage);
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

const GarmentOutput* garment_of(const RunOutputs& outputs, const std::string& slot) {
  const auto found = outputs.garments.find(slot);
  return found == outputs.garments.end() || found->second.mesh.triangles.empty() ? nullptr : &found->second;
}

const GarmentOutput* fitted_garment_of(const RunOutputs& outputs, const std::string& slot) {
  const auto found = outputs.garments.find(slot);
  return found == outputs.garments.end() || found->second.fitted.triangles.empty() ? nullptr : &found->second;
}

std::optional<Isometry3d> registered_pose(const RunOutputs& outputs, const std::string& sensor) {
  const auto pose = outputs.model_from_sensor.find(sensor);
  const auto converged = outputs.converged.find(sensor);
  if (pose == outputs.model_from_sensor.end() || converged == outputs.converged.end() || !converged->second) return {};
  return pose->second;
}

RunOutputs read_run_outputs(const fs::path& run_folder) {
  const fs::path out = run_folder / "out";
  RunOutputs outputs;
  read_registration(out / "registration.json", outputs);
  read_calibrated(out / "calibration.json", outputs);
  std::vector<std::function<void()>> jobs;
  const auto mesh = [&](const fs::path& file, Mesh& target) {
    if (fs::exists(file)) jobs.push_back([file, &target] { target = read_mesh(file); });
  };
  mesh(out / "naked_body.ply", outputs.naked_body);
  mesh(out / "user_body.ply", outputs.user_body);
  for (const std::string slot : {"top", "bottom"}) {
    if (!fs::exists(out / (slot + ".ply"))) continue;
    GarmentOutput& garment = outputs.garments[slot];
    mesh(out / (slot + ".ply"), garment.mesh);
    mesh(out / (slot + "_fitted.ply"), garment.fitted);
    const fs::path glb = out / (slot + ".glb");
    if (fs::exists(glb)) jobs.push_back([glb, &garment] { garment.textured = read_textured_mesh(glb); });
  }
  tbb::parallel_for_each(jobs.begin(), jobs.end(), [](const auto& job) { job(); });
  read_labels(out / "labels", outputs);
  if (fs::is_directory(run_folder / "stages"))
    for (const auto& stage : fs::directory_iterator(run_folder / "stages"))
      if (ends_with(stage.path().filename().string(), "_segment")) read_labels(stage.path(), outputs);
  return outputs;
}

RunOutputs read_foreign_outputs(const fs::path& run_folder) {
  const RunOutputs outputs = read_run_outputs(run_folder);
  const fs::path out = run_folder / "out";
  const auto check = [&](const Mesh& mesh, const std::string& name, double usual_side_m = kGarmentSide_m) {
    if (!mesh.triangles.empty()) check_mesh_bounds(mesh, (out / name).string(), usual_side_m);
  };
  check(outputs.naked_body, "naked_body.ply", kPersonSide_m);
  check(outputs.user_body, "user_body.ply", kPersonSide_m);
  for (const auto& [slot, garment] : outputs.garments) {
    check(garment.mesh, slot + ".ply");
    check(garment.textured.mesh, slot + ".glb");
    check(garment.fitted, slot + "_fitted.ply");
    if (!garment.textured.mesh.triangles.empty())
      check_same_surface(garment.mesh, (out / (slot + ".ply")).string(), garment.textured.mesh, slot + ".glb");
  }
  return outputs;
}

}  // namespace dressform
