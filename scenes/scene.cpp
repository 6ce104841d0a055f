#include "scenes/scene.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "scenes/calibration_toml.h"
#include "scenes/pick_names.h"
#include "scenes/scene_fields.h"
#include "scenes/scene_parts.h"
#include "scenes/toml_section.h"

namespace dressform {

constexpr double kDegree = M_PI / 180.0;

Isometry3d world_from_placed_sensor(const SensorPlace& place) {
  const double azimuth = place.azimuth_deg * kDegree;
  const Vector3d outward(std::sin(azimuth), 0, std::cos(azimuth));
  Eigen::Matrix3d level;  // columns: the sensor's right, down and forward in the world
  level.col(2) = -outward;
  level.col(1) = -Vector3d::UnitY();
  level.col(0) = level.col(1).cross(level.col(2));
  Isometry3d world_from_sensor = Isometry3d::Identity();
  world_from_sensor.linear() = (Eigen::AngleAxisd(place.yaw_deg * kDegree, Vector3d::UnitY()) * level *
                                Eigen::AngleAxisd(place.pitch_deg * kDegree, Vector3d::UnitX()).toRotationMatrix() *
                                Eigen::AngleAxisd(place.roll_deg * kDegree, Vector3d::UnitZ()).toRotationMatrix());
  world_from_sensor.translation() = outward * place.distance_m + Vector3d(0, place.height_m, 0);
  return world_from_sensor;
}

namespace {

SensorSpec read_sensor(TomlSection& section) {
  SensorSpec sensor;
  section("name", sensor.name, {}, "");
  if (sensor.name.empty() || sensor.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != sensor.name.npos)
    section.fail("name", "found \"" + sensor.name + "\"; expected letters a-z, digits and _");
  if (!is_sensor_frame(sensor.name))  // points picked in its frame would be taken for another's
    section.fail("name", "found \"" + sensor.name + "\", which names a frame of picks; expected another name");
  sensor.calibration = read_calibration(section);
  section("body_tracking", sensor.body_tracking, "");
  section("exposure", sensor.exposure, 0.05, 20.0, "", "");
  section("gain", sensor.gain, 0.1, 32.0, "", "");
  section.vector3("white_balance", sensor.white_balance, 0.2, 5, "");
  section("mosaic", sensor.mosaic, "");
  section("jpeg_quality", sensor.jpeg_quality, 0, 100, "", "");
  if (section.has("world_from_sensor")) {
    section.child("world_from_sensor", [&](TomlSection& step) { sensor.world_from_sensor = read_step(step); });
  } else {
    SensorPlace place;
    fields(section, place);
    sensor.world_from_sensor = world_from_placed_sensor(place);
  }
  return sensor;
}

// The mesh of someone's own body or garment, and how its coordinates are meant.
void read_mesh_file(TomlSection& section, std::filesystem::path& mesh, MeshFrame& frame) {
  section.path("mesh", mesh);
  fields(section, frame);
  for (const char* key : {"unit", "up", "lift_m"})
    if (mesh.empty() && section.has(key)) section.fail(key, "found it without a mesh; expected `mesh` beside it");
}

BodySpec read_body(TomlSection& section) {
  BodySpec body;
  read_mesh_file(section, body.mesh, body.frame);
  fields(section, body);
  for (const char* key : {"sex", "stature_m", "chest_m", "waist_m", "hip_m"})
    if (!body.sample.empty() && section.has(key))
      section.fail(key, "found it beside sample; expected either drawn or given measures");
  return body;
}

GarmentSpec read_garment(TomlSection& section) {
  GarmentSpec garment;
  fields(section, garment);
  if (!section.has("kind")) section.fail("", "found no kind; expected shirt, trousers, skirt or dress");
  garment.slot = garment.kind == "shirt" || garment.kind == "dress" ? "top" : "bottom";
  if (garment.name.empty()) garment.name = garment.kind;
  read_mesh_file(section, garment.mesh, garment.frame);
  section.path("texture", garment.texture);
  if (garment.mesh.empty() && !garment.texture.empty())
    section.fail("texture", "found a texture without a mesh; expected `mesh` beside it, or a [garment.print]");
  section.child("print", [&](TomlSection& print) {
    fields(print, garment.print);
    print.texts("colors", garment.print.colors);
    for (const auto& color : garment.print.colors)
      if (color.size() != 7 || color[0] != '#' || color.find_first_not_of("0123456789abcdefABCDEF", 1) != color.npos)
        print.fail("colors", "found \"" + color + "\"; expected \"#rrggbb\"");
  });
  return garment;
}

LightSpec read_light(TomlSection& section) {
  LightSpec light;
  section.vector3("position_m", light.position_m, -50, 50, "m");
  section("radius_m", light.radius_m, 0.001, 2.0, "m", "of the bulb");
  section.vector3("intensity_rgb", light.intensity_rgb, 0, 1000, "");
  return light;
}

void read_room(TomlSection& section, Scene& scene) {
  fields(section, scene.room);
  section.children("light", [&](TomlSection& light) { scene.lights.push_back(read_light(light)); });
}

void read_rig(TomlSection& section, Scene& scene) {
  std::set<std::string> names;
  section.children("sensor", [&](TomlSection& sensor) {
    scene.rig.push_back(read_sensor(sensor));
    const auto& name = scene.rig.back().name;
    if (!names.insert(name).second) sensor.fail("name", "found \"" + name + "\" twice; expected different names");
  });
  if (scene.rig.empty()) section.fail("", "found no [[sensor]]; expected at least one");
}

void read_scan(TomlSection& section, ScanSpec& scan) {
  fields(section, scan);
  if (!section.has("sensor")) section.fail("", "found no sensor; expected [scan.sensor] with an ir camera");
  section.child("sensor", [&](TomlSection& sensor) { scan.calibration = read_calibration(sensor); });
}

void read_garments(TomlSection& section, Scene& scene) {
  std::set<std::string> slots;
  section.children("garment", [&](TomlSection& garment) {
    scene.garments.push_back(read_garment(garment));
    const auto& slot = scene.garments.back().slot;
    if (!slots.insert(slot).second) garment.fail("", "found a second " + slot + " garment; expected one at most");
  });
  if (scene.garments.empty()) section.fail("", "found no [[garment]]; expected one or two");
}

void read_boards(TomlSection& section, Scene& scene) {
  BoardsSpec& boards = scene.boards.emplace();
  fields(section, boards);
  if (boards.farthest_m < boards.nearest_m)
    section.fail("farthest_m", "found less than nearest_m; expected at least as much");
}

void read_sensor_model(TomlSection& section, VariantChoice& choice) {
  section("model", choice.variant, {}, "");
  choice.values = section.values(choice.variant.c_str());
}

std::string as_comment(const TomlFiles::File& file) {
  std::string text = "# --- " + file.name + "\n# ";
  for (const char letter : file.text) text += letter == '\n' ? std::string("\n# ") : std::string(1, letter);
  return text + "\n";
}

// The scene as written, followed by the files it refers to, as comments: what it was made of can be read from one text.
std::string full_text(const TomlFiles& files) {
  std::string text = files.files().front().text;
  for (std::size_t i = 1; i < files.files().size(); ++i) {
    const auto& file = files.files()[i];
    text += (text.empty() || text.back() == '\n' ? "" : "\n") + ("\n" + as_comment(file));
  }
  return text;
}

Scene read(TomlFiles& files, const std::filesystem::path& file) {
  Scene scene;
  scene.file = file;
  TomlSection section(files, files.open(file, file.filename().string(), ""), "");
  scene.name = file.stem().string();
  section("name", scene.name, {}, "");
  section("description", scene.description, {}, "");
  section.child("room", [&](TomlSection& room) { read_room(room, scene); });
  if (scene.lights.empty()) scene.lights.push_back({});
  section.child("body", [&](TomlSection& body) { scene.body = read_body(body); });
  scene.user = scene.body;
  section.child("user", [&](TomlSection& user) { scene.user = read_body(user); });
  for (const char* key : {"rig", "scan"})
    if (!section.has(key)) section.fail("", std::string("found no ") + key + "; expected a table or a file name");
  section.child("rig", [&](TomlSection& rig) { read_rig(rig, scene); });
  section.child("scan", [&](TomlSection& scan) { read_scan(scan, scene.scan); });
  read_garments(section, scene);
  section.child("prior", [&](TomlSection& prior) { fields(prior, scene.prior); });
  section.child("boards", [&](TomlSection& boards) { read_boards(boards, scene); });
  section.child("calibration", [&](TomlSection& given) { fields(given, scene.given_calibration); });
  section.child("operator", [&](TomlSection& hand) { fields(hand, scene.picking); });
  section.child("sensor", [&](TomlSection& sensor) { read_sensor_model(sensor, scene.sensor_model); });
  section.finish();
  scene.toml = full_text(files);
  return scene;
}

void read_other_rig(TomlSection& section, Scene& scene) {
  scene.rig.clear();
  read_rig(section, scene);
}

void read_other_scan(TomlSection& section, Scene& scene) {
  scene.scan = {};
  read_scan(section, scene.scan);
}

using ReadPart = void(TomlSection&, Scene&);

// The scene with one part read from a file. All files that the part is made of stand in the text: a stored capture is
// known by it.
Scene with_part(const Scene& scene, const char* part, const std::filesystem::path& file, ReadPart* read_part,
                TomlFiles& files) {
  TomlSection section(files, files.open(file, file.filename().string(), ""), part);
  Scene result = scene;
  read_part(section, result);
  section.finish();
  result.toml += std::string("\n# --- instead of its ") + part + "\n";
  for (const auto& each : files.files()) result.toml += as_comment(each);
  return result;
}

std::vector<std::string> names_of(const TomlFiles& files) {
  std::vector<std::string> names;
  for (const auto& file : files.files()) names.push_back(file.name);
  return names;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file) {
  TomlFiles files;
  return read(files, file);
}

Scene with_rig(const Scene& scene, const std::filesystem::path& file) {
  TomlFiles files;
  return with_part(scene, "rig", file, read_other_rig, files);
}

Scene with_scan(const Scene& scene, const std::filesystem::path& file) {
  TomlFiles files;
  return with_part(scene, "scan", file, read_other_scan, files);
}

std::vector<std::string> files_of_rig(const std::filesystem::path& file) {
  TomlFiles files;
  with_part({}, "rig", file, read_other_rig, files);
  return names_of(files);
}

std::vector<std::string> files_of_scan(const std::filesystem::path& file) {
  TomlFiles files;
  with_part({}, "scan", file, read_other_scan, files);
  return names_of(files);
}

Scene scaled(const Scene& scene, double scale) {
  if (!(scale > 0 && scale <= 1))
    throw InputError("scale", "found " + to_text(FieldValue(scale)) + "; expected a number above 0, at most 1");
  if (scale == 1) return scene;
  Scene result = scene;
  const auto shrink = [&](SensorCalibration& calibration) {
    calibration.ir = calibration.ir.scaled(scale);
    if (calibration.color) calibration.color = calibration.color->scaled(scale);
  };
  for (auto& sensor : result.rig) shrink(sensor.calibration);
  shrink(result.scan.calibration);
  // Below the scale from which targets are meant to hold, walks lose frames too, down to what one needs: with 60 of 120
  // at 0.4, bodies are as near the truth (medians +.05 mm); with 72 at 0.6 views would stand .6 mm worse.
  constexpr double kAllFrames = 0.6;
  constexpr int kLeastFrames = 60;  // six degrees apart
  const int frames = static_cast<int>(std::lround(scene.scan.frames * std::min(1.0, scale / kAllFrames)));
  result.scan.frames = std::min(scene.scan.frames, std::max(kLeastFrames, frames));
  result.picking.click_px *= scale;  // the hand sees the same picture
  return result;
}

}  // namespace dressform
