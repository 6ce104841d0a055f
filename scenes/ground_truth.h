#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/camera.h"
#include "scenes/mesh.h"

namespace dressform {

// How simulated cloth lies: whether it came to rest, and how far it is stretched. Anyone's own clothes are placed as
// given, at rest.
struct ClothRest {
  bool settled = true;
  double speed_m_per_s = 0;  // mean over the vertices, at the end of the fall
  double strain_p95 = 0;     // |length / length as cut - 1| that 95 % of the edges keep to
};

struct TruthGarment {
  Mesh mesh;                        // world frame
  std::vector<std::uint8_t> views;  // per vertex: how many sensors see it; empty: not known
  TexturedMesh textured;            // the same surface with its print (from the GLB); empty: not known
  ClothRest rest;
};
struct TruthRim {
  std::string name;              // "neck", "left_cuff", "waist", "hem", ...
  double visible = 0;            // part of the length that some sensor sees
  std::vector<Vector3d> points;  // world frame, closed (the last joins the first)
};

// What a synthetic session knows and the pipeline must not: only `eval` reads it.
struct GroundTruth {
  std::map<std::string, Isometry3d> world_from_sensor;                    // IR camera
  std::map<std::string, std::vector<Isometry3d>> scan_world_from_sensor;  // "scan_naked", "scan_user": per frame
  std::optional<Calibration> calibration;                                 // the true one, where it differs
  Mesh naked_body, user_body;                                             // closed; the user in its own scan's world
  std::map<std::string, TruthGarment> garments;                           // "top", "bottom"
  std::map<std::string, std::vector<TruthRim>> rims;                      // by garment
  std::map<std::string, cv::Mat> labels;  // by sensor; uint8 at colour size: 0 none 1 skin 2 top 3 bottom
  std::string scene_toml;
};

// One line for each thing that is wrong with how the clothes of SESSION/truth lie; none where there is no truth.
std::vector<std::string> drape_warnings(const std::filesystem::path& session_folder);

// The garments that SESSION/truth has, sorted; none where there is no truth.
std::vector<std::string> truth_garment_names(const std::filesystem::path& session_folder);

// Reads SESSION/truth. Any part of it may be missing (poses only, meshes without texture, no labels) and is empty then.
// Throws InputError naming a file that is there and damaged, and when nothing is there that a run could be judged by;
// `exists` tells whether there is any truth at all.
bool ground_truth_exists(const std::filesystem::path& session_folder);
GroundTruth read_ground_truth(const std::filesystem::path& session_folder);
void write_ground_truth(const std::filesystem::path& session_folder, const GroundTruth& truth);

}  // namespace dressform
