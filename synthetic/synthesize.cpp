#include "synthetic/synthesize.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "scenes/random.h"
#include "synthetic/boards/board.h"
#include "synthetic/boards/given_calibration.h"
#include "synthetic/body/body.h"
#include "synthetic/body/body_tracking.h"
#include "synthetic/body/scan_path.h"
#include "synthetic/capture/color_camera.h"
#include "synthetic/capture/visibility.h"
#include "synthetic/garments/garment.h"
#include "synthetic/room/room.h"
#include "synthetic/sensors/sensor_model.h"

namespace dressform {
namespace {

// A seed of its own for each image, so that no two share their noise.
Seed derived(Seed seed, const std::string& what) {
  const auto numbers = uniform4(seed, stream_of(what.c_str()), 0);
  return static_cast<Seed>(numbers[0] * 0x1p31) << 32 | static_cast<Seed>(numbers[1] * 0x1p32);
}

// Counts finished images for the caller.
class Meter {
 public:
  Meter(const SynthesisProgress& progress, int total) : progress_(progress), total_(total) {}
  void step(const std::string& what) {
    ++done_;
    if (progress_) progress_(done_, total_, what);
  }

 private:
  const SynthesisProgress& progress_;
  int total_, done_ = 0;
};

RaySurface skin_surface(const Body& body, const Vector3f& srgb, float nir_albedo, float gloss) {
  RaySurface surface;
  surface.name = "body";
  surface.mesh = body.mesh;
  for (int c = 0; c < 3; ++c) surface.material.albedo_rgb[c] = linear_from_srgb(srgb[c]);
  surface.material.nir_albedo = nir_albedo;
  surface.material.gloss = gloss;
  surface.label = Label::skin;
  return surface;
}

RaySurface mannequin_surface(const Body& body) { return skin_surface(body, {0.86f, 0.78f, 0.70f}, 0.55f, 0.12f); }
RaySurface user_surface(const Body& body) { return skin_surface(body, {0.30f, 0.33f, 0.38f}, 0.50f, 0.0f); }

// Dyes look alike to an infrared camera; each garment has its own brightness all the same.
RaySurface garment_surface(const GarmentSpec& spec, const Garment& garment) {
  RaySurface surface;
  surface.name = spec.name;
  surface.mesh = garment.textured.mesh;
  surface.corner_uv = garment.textured.corner_uv;
  surface.texture = garment.textured.texture;
  surface.material.albedo_rgb = Vector3f::Ones();
  surface.material.nir_albedo = 0.38f + 0.22f * static_cast<float>(uniform(stream_of(spec.name.c_str()), 0, 0));
  surface.material.nir_print = 0.3f;
  surface.label = spec.slot == "top" ? Label::top : Label::bottom;
  return surface;
}

std::vector<RaySurface> joined(std::vector<RaySurface> first, const std::vector<RaySurface>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

// Trousers before shirts, unless the shirt is tucked in: what is worn beneath comes first.
std::vector<const GarmentSpec*> inner_first(const Scene& scene) {
  std::vector<const GarmentSpec*> order;
  for (const auto& spec : scene.garments) order.push_back(&spec);
  const auto layer = [](const GarmentSpec* spec) { return spec->slot == "bottom" ? 1 : spec->tucked ? 0 : 2; };
  std::stable_sort(order.begin(), order.end(),
                   [&](const GarmentSpec* a, const GarmentSpec* b) { return layer(a) < layer(b); });
  return order;
}

bool inside(const RoomSpec& room, const Vector3d& place) {
  return std::abs(place.x()) < 0.5 * room.width_m && std::abs(place.z()) < 0.5 * room.depth_m && place.y() > 0 &&
         place.y() < room.height_m;
}

void check_rig_stands_inside(const Scene& scene) {
  for (const auto& sensor : scene.rig)
    if (!inside(scene.room, sensor.world_from_sensor.translation()))
      throw InputError("rig." + sensor.name, "stands outside the room; expected a place inside it");
}

std::vector<Isometry3d> path_inside(const Scene& scene, const Body& body, Seed seed) {
  const auto path = make_scan_path(scene.scan, body.landmarks.stature, seed);
  for (const auto& pose : path)
    if (!inside(scene.room, pose.translation()))
      throw InputError("scan.radius_m", "the walk leaves the room; expected a radius that stays inside it");
  return path;
}

int images_of(const Scene& scene) {
  const int sensors = static_cast<int>(scene.rig.size());
  return 2 * sensors + 2 * scene.scan.frames + (scene.boards ? sensors * scene.boards->views : 0);
}

struct Optics {
  RayTable ir;
  std::unique_ptr<RayTable> color;
};

// All that the captures of one scene share.
class Studio {
 public:
  Studio(const Scene& scene, Seed seed, const SynthesisProgress& progress)
      : scene_(scene),
        seed_(seed),
        model_(SensorModel::at(scene.sensor_model.variant)),
        meter_(progress, images_of(scene)),
        lighting_(make_lighting(scene.lights, scene.room)),
        exposure_(nominal_exposure(lighting_)) {
    model_.complete(scene.sensor_model.values);
    for (const auto& sensor : scene.rig) {
      const auto& color = sensor.calibration.color;
      optics_.push_back({RayTable(sensor.calibration.ir), color ? std::make_unique<RayTable>(*color) : nullptr});
    }
  }

  // `name`: "naked" or "dressed".
  std::map<std::string, Shot> shoot(const RayScene& world, const Body& body, const std::string& name) {
    const IndirectLight indirect(world, lighting_);
    std::map<std::string, Shot> shots;
    for (std::size_t i = 0; i < scene_.rig.size(); ++i) {
      const SensorSpec& sensor = scene_.rig[i];
      shots[sensor.name] = shot(world, indirect, &body, sensor, optics_[i], derived(seed_, name + "/" + sensor.name));
      meter_.step(name + "/" + sensor.name);
    }
    return shots;
  }

  // Shots of the board before every sensor, in an otherwise empty room.
  Boards boards(const BoardsSpec& spec, const std::vector<RaySurface>& around) {
    Boards result{spec.squares_x - 1, spec.squares_y - 1, spec.square_m, {}};
    for (std::size_t i = 0; i < scene_.rig.size(); ++i) {
      const SensorSpec& sensor = scene_.rig[i];
      std::unique_ptr<IndirectLight> indirect;  // changes little with the board's pose: gathered once
      for (const auto& ir_from_board : board_poses(spec, sensor, seed_)) {
        auto& shots = result.shots[sensor.name];
        const std::string name = "boards/" + sensor.name + "/" + std::to_string(shots.size());
        const RayScene world(joined(around, {make_board(spec, sensor.world_from_sensor * ir_from_board)}));
        if (!indirect) indirect = std::make_unique<IndirectLight>(world, lighting_);
        Shot taken = shot(world, *indirect, nullptr, sensor, optics_[i], derived(seed_, name));
        shots.push_back({taken.color, taken.ir, taken.depth_mm});
        meter_.step(name);
      }
    }
    return result;
  }

  DepthScan scan(const RayScene& world, const std::vector<Isometry3d>& path, const std::string& name) {
    const RayTable rays(scene_.scan.calibration.ir);
    DepthScan result{"handheld", {}};
    for (std::size_t i = 0; i < path.size(); ++i) {
      const std::string frame = name + "/" + std::to_string(i);
      const IrView view(world, rays, scene_.scan.calibration.ir, path[i], scene_.scan.calibration.depth_offset_m, false,
                        stream_of("handheld"));
      result.depth_mm.push_back(measure(view, derived(seed_, frame)).depth_mm);
      meter_.step(frame);
    }
    return result;
  }

  std::map<std::string, cv::Mat> labels(const RayScene& world) const {
    std::map<std::string, cv::Mat> result;
    for (std::size_t i = 0; i < scene_.rig.size(); ++i)
      if (optics_[i].color)
        result[scene_.rig[i].name] = render_labels(world, *optics_[i].color, world_from_color(scene_.rig[i]));
    return result;
  }

 private:
  static Isometry3d world_from_color(const SensorSpec& sensor) {
    return sensor.world_from_sensor * sensor.calibration.color_from_ir.inverse();
  }

  SensorFrame measure(const IrView& view, Seed seed) const {
    return model_.run(view, scene_.sensor_model.values, seed);
  }

  // `body`: whom the sensor tracks, if it does; null: nobody is there.
  Shot shot(const RayScene& world, const IndirectLight& indirect, const Body* body, const SensorSpec& sensor,
            const Optics& optics, Seed seed) const {
    Shot result;
    if (optics.color) {
      FilmSpec film;
      film.gain = exposure_ * static_cast<float>(sensor.exposure * sensor.gain);
      film.electrons_full_scale /= static_cast<float>(sensor.gain);
      film.white_balance = sensor.white_balance.cast<float>();
      film.mosaic = sensor.mosaic;
      film.jpeg_quality = sensor.jpeg_quality;
      result.color = render_color(world, lighting_, indirect, *optics.color, world_from_color(sensor), film, seed);
    }
    const IrView view(world, optics.ir, sensor.calibration.ir, sensor.world_from_sensor,
                      sensor.calibration.depth_offset_m, true, stream_of(sensor.name.c_str()));
    const SensorFrame frame = measure(view, seed);
    result.depth_mm = frame.depth_mm;
    result.ir = frame.ir;
    if (!sensor.body_tracking || !body) return result;
    result.body_index = track_body_index(view, seed);
    result.skeleton = track_skeleton(*body, view, seed);
    return result;
  }

  const Scene& scene_;
  Seed seed_;
  const SensorModel::Entry& model_;
  Meter meter_;
  Lighting lighting_;
  float exposure_;
  std::vector<Optics> optics_;
};

CaptureSession empty_session(const Scene& scene, Seed seed) {
  CaptureSession session;
  session.name = scene.name;
  session.created_by = "dressform " DRESSFORM_VERSION;
  session.licence = "CC0-1.0";
  for (const auto& sensor : scene.rig) session.sensors.push_back(sensor.name);
  session.calibration = given_calibration(scene, seed);
  session.prior =
      RigPrior{perturbed_rig(scene.rig, scene.prior, seed), scene.prior.rotation_deg, scene.prior.translation_m};
  return session;
}

// The true calibration, where the session says another one or is to find it out from boards.
std::optional<Calibration> true_calibration(const Scene& scene) {
  if (!scene.boards && scene.given_calibration.exact()) return {};
  Scene exact = scene;
  exact.given_calibration = {};
  return given_calibration(exact, 0);
}

void add_garment_truth(const Scene& scene, const GarmentSpec& spec, const Garment& garment, const RayScene& dressed,
                       GroundTruth& truth) {
  TruthGarment& entry = truth.garments[spec.slot];
  entry.mesh = garment.textured.mesh;
  entry.textured = garment.textured;
  entry.rest = garment.rest;
  entry.views = count_views(dressed, entry.mesh, scene.rig);
  for (TruthRim rim : garment.rims) {
    rim.visible = visible_part(dressed, rim.points, scene.rig);
    truth.rims[spec.slot].push_back(std::move(rim));
  }
}

// Naked and dressed shots of the rig, with all that is true of the dressed one.
void take_shots(const Scene& scene, Studio& studio, const Body& body, const std::vector<RaySurface>& around, Seed seed,
                SyntheticCapture& out) {
  const auto set = joined(joined(around, make_rig_hardware(scene.rig)), {mannequin_surface(body)});
  out.session.naked = studio.shoot(RayScene(set), body, "naked");
  std::vector<Garment> worn;
  std::vector<RaySurface> cloth;
  const auto specs = inner_first(scene);
  for (const GarmentSpec* spec : specs) {
    worn.push_back(make_garment(*spec, body, worn, seed));
    cloth.push_back(garment_surface(*spec, worn.back()));
  }
  const RayScene dressed(joined(set, cloth));
  out.session.dressed = studio.shoot(dressed, body, "dressed");
  out.truth.labels = studio.labels(dressed);
  for (std::size_t i = 0; i < specs.size(); ++i) add_garment_truth(scene, *specs[i], worn[i], dressed, out.truth);
}

std::vector<RaySurface> empty_room(const Scene& scene) {
  return joined(joined(make_room(scene.room), make_bulbs(scene.lights)), make_rig_hardware(scene.rig));
}

}  // namespace

SyntheticCapture synthesize(const Scene& scene, Seed seed, const SynthesisProgress& progress) {
  check_rig_stands_inside(scene);
  Studio studio(scene, seed, progress);
  SyntheticCapture out{empty_session(scene, seed), {}};
  GroundTruth& truth = out.truth;
  const Body body = make_body(scene.body), user = make_body(scene.user);
  const auto naked_path = path_inside(scene, body, derived(seed, "scan_naked"));
  const auto user_path = path_inside(scene, user, derived(seed, "scan_user"));
  const auto room = make_room(scene.room);
  const auto around = joined(joined(room, make_bulbs(scene.lights)), make_stand(body));
  take_shots(scene, studio, body, around, seed, out);
  out.session.scans["scan_naked"] =
      studio.scan(RayScene(joined(around, {mannequin_surface(body)})), naked_path, "scan_naked");
  out.session.scans["scan_user"] = studio.scan(RayScene(joined(room, {user_surface(user)})), user_path, "scan_user");
  truth.scan_world_from_sensor = {{"scan_naked", naked_path}, {"scan_user", user_path}};
  for (const auto& sensor : scene.rig) truth.world_from_sensor[sensor.name] = sensor.world_from_sensor;
  if (scene.boards) out.session.boards = studio.boards(*scene.boards, empty_room(scene));
  truth.calibration = true_calibration(scene);
  truth.naked_body = body.mesh;
  truth.user_body = user.mesh;
  truth.scene_toml = scene.toml;
  return out;
}

SyntheticCapture synthesize_boards(const Scene& scene, Seed seed, const SynthesisProgress& progress) {
  if (!scene.boards) throw InputError("boards", "the scene has none; expected a table [boards]");
  check_rig_stands_inside(scene);
  Studio studio(scene, seed, progress);
  SyntheticCapture out{empty_session(scene, seed), {}};
  out.session.boards = studio.boards(*scene.boards, empty_room(scene));
  out.truth.calibration = true_calibration(scene);
  return out;
}

}  // namespace dressform
