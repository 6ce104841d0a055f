#include "synthetic/synthesize.h"

#include <algorithm>
#include <cmath>

#include "scenes/random.h"
#include "synthetic/boards/given_calibration.h"
#include "synthetic/body/body.h"
#include "synthetic/body/scan_path.h"
#include "synthetic/capture/visibility.h"
#include "synthetic/garments/garment.h"
#include "synthetic/operator/operator.h"
#include "synthetic/room/room.h"
#include "synthetic/studio.h"

namespace dressform {
namespace {

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

// Naked and dressed shots of the rig, with all that is true of the dressed one and what is picked on it.
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
  WornGarments by_slot;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    add_garment_truth(scene, *specs[i], worn[i], dressed, out.truth);
    by_slot[specs[i]->slot] = &worn[i];
  }
  if (scene.picking.picks) out.picks = operate_on_clothes(scene, dressed, by_slot, out, seed);
}

std::vector<RaySurface> empty_room(const Scene& scene) {
  return joined(joined(make_room(scene.room), make_bulbs(scene.lights)), make_rig_hardware(scene.rig));
}

}  // namespace

SyntheticCapture synthesize(const Scene& scene, Seed seed, const SynthesisProgress& progress) {
  check_rig_stands_inside(scene);
  Studio studio(scene, seed, progress);
  SyntheticCapture out{empty_session(scene, seed), {}, {}};
  GroundTruth& truth = out.truth;
  const Body body = make_body(scene.body), user = make_body(scene.user);
  const auto naked_path = path_inside(scene, body, derived_seed(seed, "scan_naked"));
  const auto user_path = path_inside(scene, user, derived_seed(seed, "scan_user"));
  const auto room = make_room(scene.room);
  const auto around = joined(joined(room, make_bulbs(scene.lights)), make_stand(body));
  take_shots(scene, studio, body, around, seed, out);
  out.session.scans["scan_naked"] =
      studio.scan(RayScene(joined(around, {mannequin_surface(body)})), naked_path, "scan_naked");
  out.session.scans["scan_user"] = studio.scan(RayScene(joined(room, {user_surface(user)})), user_path, "scan_user");
  if (out.picks) pick_body_pairs({body, naked_path}, {user, user_path}, scene.picking.click_mm, seed, *out.picks);
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
  SyntheticCapture out{empty_session(scene, seed), {}, {}};
  out.session.boards = studio.boards(*scene.boards, empty_room(scene));
  out.truth.calibration = true_calibration(scene);
  return out;
}

}  // namespace dressform
