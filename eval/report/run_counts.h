#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/reconstruct.h"

namespace dressform {

// What the thesis counts of a run: pixels of the views, points of the clouds, vertices and faces of the meshes.
struct MeshCounts {
  long long vertices = 0, faces = 0, boundary_edges = 0;
};
struct GarmentCounts {
  struct Pixels {
    long long seen = 0, filled = 0;  // of the garment before filling, and what was added
  };
  std::map<std::string, Pixels> pixels;      // by sensor, at colour size
  std::optional<long long> points, cleaned;  // of the aligned views, and what surface made the garment from
  std::optional<MeshCounts> closed, open;
  std::string not_closed, not_open;  // why not, where it is known
};
struct RunCounts {
  std::string run, scene;
  double scale = 1;
  std::vector<std::string> sensors;
  Calibration calibration;
  std::map<std::string, Isometry3d> model_from_sensor;
  std::map<std::string, std::string> not_registered;  // why
  std::map<std::string, std::string> view;            // by sensor: "Front", "Back", "Left", "Right" of the mannequin
  std::map<std::string, long long> mannequin, image;  // pixels of the dressed shot, at colour size
  std::map<std::string, GarmentCounts> garments;      // "top", "bottom"
};

// "Front", "Back", "Left" or "Right": the side of the body (its own left) that a sensor at the place sees.
std::string view_of(const Landmarks& body, const Vector3d& sensor_in_model);

RunCounts counts_of(const Reconstruction& made, const std::string& run, const std::string& scene, double scale);

}  // namespace dressform
