#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/camera.h"
#include "scenes/mesh_frame.h"
#include "scenes/registry.h"

namespace dressform {

// What a person writes in a scene file (TOML; scenes/README.md has the format). Metres, degrees, world frame: y up,
// floor y = 0, mannequin at the origin facing +z.

struct BodySpec {
  std::filesystem::path mesh;  // someone's own closed body, placed as given; empty: the procedural body
  MeshFrame frame;             // of `mesh`
  std::string sex = "male";    // proportions: "male" or "female"
  std::string sample;          // "man" or "woman": stature and girths are drawn from the survey; empty: as given
  int sample_seed = 1;         // which of the customers that can be drawn
  double stature_m = 1.85, chest_m = 1.01, waist_m = 0.81, hip_m = 0.91;   // girths: tape (convex hull) round the body
  double inseam_m = 0, knee_height_m = 0, upper_arm_m = 0, forearm_m = 0;  // segments; 0: as usual with these girths
  double neck_m = 0;                                                       // girth of the neck; 0: likewise
  double chin_m = 0;               // how far jaw and chin jut forward and down, beyond the usual
  double bow_deg = 0;              // how far the head is bowed
  double hunch_m = 0;              // how far neck and head stand forward of an upright back
  std::string pose = "mannequin";  // mannequin, a_pose, bent_arms, one_arm_bent
  double arm_angle_deg = 0;        // upper arms out from the vertical; 0: the pose's own
};

struct PrintSpec {
  std::string kind = "plain";       // plain, stars, complex, stripes, denim, weave, ...
  std::vector<std::string> colors;  // "#rrggbb": ground colour, then print colours
  std::string text;                 // characters to print, for kinds that print text
};

struct GarmentSpec {
  std::string name;                     // for the report: "shirt 1"
  std::string slot = "top";             // "top" or "bottom"
  std::string kind = "shirt";           // shirt, trousers, skirt, dress
  std::filesystem::path mesh, texture;  // someone's own garment, placed as given; empty: procedural
  MeshFrame frame;                      // of `mesh`
  double sleeve = 0.45;                 // part of the arm from shoulder to wrist that is covered (shirts)
  double length = 1.0;                  // trousers, skirts, dresses: part of the way from waist to ankle
  double hem_below_waist_m = 0.20;      // shirts: how far the hem hangs below the waist
  std::string neck = "round";           // shirts, dresses: round, v
  double neck_depth_m = 0.10;           // of the neckline in front, below the neck's side; polo: of the slit
  std::string collar = "none";          // shirts, dresses: none, polo, hood
  bool tucked = false;                  // shirts: worn inside the trousers or skirt
  double hem_slant = 0;                 // of the hem: rise per metre towards the front
  double waist_offset_m = 0;            // trousers, skirts: how far above the natural waist they are worn
  double ease_m = 0.06;                 // garment girth minus body girth, at chest (tops) or hip (bottoms)
  double fullness = 0.06;               // cloth beyond the smooth shape, part of its width: it falls in folds
  double flare = 0.3;                   // skirts, dresses: how much wider the hem is cut than it hangs
  double bending_length_m = 0.018;      // a strip of the cloth bends by its own weight over this length (Peirce)
  double cloth_edge_m = 0.0075;         // of the triangles that the cloth is made of
  PrintSpec print;
};

struct SensorSpec {
  std::string name;               // "k1", ...
  SensorCalibration calibration;  // the true one; see GivenCalibrationSpec for what the session says
  Isometry3d world_from_sensor = Isometry3d::Identity();  // IR camera, true
  bool body_tracking = false;                             // the SDK tracks front and back views only
  double exposure = 1.0;                      // linear gain of the colour camera against the scene's nominal exposure
  double gain = 1.0;                          // amplification of the colour camera: brightens, and the noise with it
  Vector3d white_balance = Vector3d::Ones();  // linear gain per channel (RGB)
  bool mosaic = true;                         // a Bayer filter before the colour camera's pixels
  int jpeg_quality = 90;                      // of the colour stream; 0: uncompressed
};

struct LightSpec {
  Vector3d position_m = Vector3d(0, 2.3, 2.0);
  double radius_m = 0.05;  // of the bulb: makes the shadows soft
  Vector3d intensity_rgb = Vector3d::Ones();
};

struct RoomSpec {
  double width_m = 6.0, depth_m = 5.0, height_m = 2.7;  // x, z, y
  bool furniture = true;
};

struct ScanSpec {
  SensorCalibration calibration;  // the hand-held sensor (depth only)
  int frames = 120;
  double radius_m = 1.9, height_m = 1.15;
};

struct PriorSpec {
  double rotation_deg = 5.0;  // sigma of the rig prior's error, cut at twice that
  double translation_m = 0.08;
};

// Shots of a checkerboard before every sensor of the rig, to calibrate from. Made only where a scene has the table.
struct BoardsSpec {
  int squares_x = 12, squares_y = 20;  // of the printed pattern; its inner corners are one fewer each way
  double square_m = 0.028;
  int views = 25;  // poses per sensor
  double nearest_m = 0.7, farthest_m = 1.6, tilt_deg = 40;
};

// How far the calibration that the session brings along is off the true one: sigmas, drawn for each sensor of the rig.
struct GivenCalibrationSpec {
  double focal_percent = 0, principal_px = 0, rotation_deg = 0, translation_mm = 0, depth_offset_mm = 0;
  bool distortion = true;  // false: it knows no distortion, like the thesis's tables

  bool exact() const {
    return focal_percent == 0 && principal_px == 0 && rotation_deg == 0 && translation_mm == 0 &&
           depth_offset_mm == 0 && distortion;
  }
};

// What the operator of the thesis picks by hand (scenes/picks.h), played from the truth, and how steadily.
struct PickingSpec {
  bool picks = true;
  double click_px = 1.5;  // sigma of a click where the colours show: in pixels of a sensor's colour image
  double click_mm = 3.0;  // on bodies, which have no colours
};

// A named model and its parameters, e.g. sensor = "kinect_v2" with [sensor.kinect_v2] overrides.
struct VariantChoice {
  std::string variant;
  FieldValues values;
};

struct Scene {
  std::string name;
  std::filesystem::path file;  // where it was read; relative paths in it start at this file's folder
  std::string toml;            // the text as read, for provenance
  std::string description;
  RoomSpec room;
  std::vector<LightSpec> lights;
  BodySpec body, user;
  std::vector<GarmentSpec> garments;  // at most one per slot
  std::vector<SensorSpec> rig;
  ScanSpec scan;
  PriorSpec prior;
  std::optional<BoardsSpec> boards;
  GivenCalibrationSpec given_calibration;
  PickingSpec picking;
  VariantChoice sensor_model{"kinect_v2", {}};
};

// Reads a scene file and the files it refers to (`rig = "rigs/thesis.toml"`). Throws InputError with file, line and
// column for syntax, unknown keys, wrong types and ranges.
Scene read_scene(const std::filesystem::path& file);

// The scene with all images resampled by `scale` (0 < scale <= 1), for quick runs; below 0.6 walks of more
// than 60 frames lose frames too.
Scene scaled(const Scene& scene, double scale);

}  // namespace dressform
