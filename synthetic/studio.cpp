#include "synthetic/studio.h"

#include "scenes/random.h"
#include "synthetic/boards/board.h"
#include "synthetic/body/body_tracking.h"
#include "synthetic/capture/color_camera.h"

namespace dressform {
namespace {

int images_of(const Scene& scene) {
  const int sensors = static_cast<int>(scene.rig.size());
  return 2 * sensors + 2 * scene.scan.frames + (scene.boards ? sensors * scene.boards->views : 0);
}

}  // namespace

Seed derived_seed(Seed seed, const std::string& what) {
  const auto numbers = uniform4(seed, stream_of(what.c_str()), 0);
  return static_cast<Seed>(numbers[0] * 0x1p31) << 32 | static_cast<Seed>(numbers[1] * 0x1p32);
}

std::vector<RaySurface> joined(std::vector<RaySurface> first, const std::vector<RaySurface>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Studio::Studio(const Scene& scene, Seed seed, const SynthesisProgress& progress)
    : scene_(scene),
      seed_(seed),
      model_(SensorModel::at(scene.sensor_model.variant)),
      meter_(progress, images_of(scene)),
      lighting_(make_lighting(scene.lights, scene.room)),
      exposure_(nominal_exposure(lighting_)) {
  model_.complete(scene.sensor_model.values);
  for (const auto& sensor : scene.rig) {
    const auto& color = sensor.calibration.color;
    rays_.push_back({RayTable(sensor.calibration.ir), color ? std::make_unique<RayTable>(*color) : nullptr});
  }
}

std::map<std::string, Shot> Studio::shoot(const RayScene& world, const Body& body, const std::string& name) {
  const IndirectLight indirect(world, lighting_);
  std::map<std::string, Shot> shots;
  for (std::size_t i = 0; i < scene_.rig.size(); ++i) {
    const SensorSpec& sensor = scene_.rig[i];
    shots[sensor.name] = shot(world, indirect, &body, sensor, rays_[i], derived_seed(seed_, name + "/" + sensor.name));
    meter_.step(name + "/" + sensor.name);
  }
  return shots;
}

Boards Studio::boards(const BoardsSpec& spec, const std::vector<RaySurface>& around) {
  Boards result{spec.squares_x - 1, spec.squares_y - 1, spec.square_m, {}};
  for (std::size_t i = 0; i < scene_.rig.size(); ++i) {
    const SensorSpec& sensor = scene_.rig[i];
    std::unique_ptr<IndirectLight> indirect;  // changes little with the board's pose: gathered once
    for (const auto& ir_from_board : board_poses(spec, sensor, seed_)) {
      auto& shots = result.shots[sensor.name];
      const std::string name = "boards/" + sensor.name + "/" + std::to_string(shots.size());
      const RayScene world(joined(around, {make_board(spec, sensor.world_from_sensor * ir_from_board)}));
      if (!indirect) indirect = std::make_unique<IndirectLight>(world, lighting_);
      Shot taken = shot(world, *indirect, nullptr, sensor, rays_[i], derived_seed(seed_, name));
      shots.push_back({taken.color, taken.ir, taken.depth_mm});
      meter_.step(name);
    }
  }
  return result;
}

DepthScan Studio::scan(const RayScene& world, const std::vector<Isometry3d>& path, const std::string& name) {
  const RayTable rays(scene_.scan.calibration.ir);
  DepthScan result{"handheld", {}};
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string frame = name + "/" + std::to_string(i);
    const IrView view(world, rays, scene_.scan.calibration.ir, path[i], scene_.scan.calibration.depth_offset_m, false,
                      stream_of("handheld"));
    result.depth_mm.push_back(measure(view, derived_seed(seed_, frame)).depth_mm);
    meter_.step(frame);
  }
  return result;
}

std::map<std::string, cv::Mat> Studio::labels(const RayScene& world) const {
  std::map<std::string, cv::Mat> result;
  for (std::size_t i = 0; i < scene_.rig.size(); ++i)
    if (rays_[i].color)
      result[scene_.rig[i].name] = render_labels(world, *rays_[i].color, world_from_color(scene_.rig[i]));
  return result;
}

Isometry3d Studio::world_from_color(const SensorSpec& sensor) {
  return sensor.world_from_sensor * sensor.calibration.color_from_ir.inverse();
}

SensorFrame Studio::measure(const IrView& view, Seed seed) const {
  return model_.run(view, scene_.sensor_model.values, seed);
}

Shot Studio::shot(const RayScene& world, const IndirectLight& indirect, const Body* body, const SensorSpec& sensor,
                  const SensorRays& rays, Seed seed) const {
  Shot result;
  if (rays.color) {
    FilmSpec film;
    film.gain = exposure_ * static_cast<float>(sensor.exposure * sensor.gain);
    film.electrons_full_scale /= static_cast<float>(sensor.gain);
    film.white_balance = sensor.white_balance.cast<float>();
    film.mosaic = sensor.mosaic;
    film.jpeg_quality = sensor.jpeg_quality;
    result.color = render_color(world, lighting_, indirect, *rays.color, world_from_color(sensor), film, seed);
  }
  const IrView view(world, rays.ir, sensor.calibration.ir, sensor.world_from_sensor, sensor.calibration.depth_offset_m,
                    true, stream_of(sensor.name.c_str()));
  const SensorFrame frame = measure(view, seed);
  result.depth_mm = frame.depth_mm;
  result.ir = frame.ir;
  if (!sensor.body_tracking || !body) return result;
  result.body_index = track_body_index(view, seed);
  result.skeleton = track_skeleton(*body, view, seed);
  return result;
}

}  // namespace dressform
