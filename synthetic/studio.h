#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/capture_session.h"
#include "synthetic/body/body.h"
#include "synthetic/capture/indirect_light.h"
#include "synthetic/capture/light.h"
#include "synthetic/capture/ray_table.h"
#include "synthetic/sensors/sensor_model.h"
#include "synthetic/synthesize.h"

namespace dressform {

// A seed of its own for each image, so that no two share their noise.
Seed derived_seed(Seed seed, const std::string& what);

std::vector<RaySurface> joined(std::vector<RaySurface> first, const std::vector<RaySurface>& second);

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

struct SensorRays {
  RayTable ir;
  std::unique_ptr<RayTable> color;
};

// All that the captures of one scene share: rig, sensor model, lights. Throws InputError for a sensor model or
// parameter that is not known.
class Studio {
 public:
  Studio(const Scene& scene, Seed seed, const SynthesisProgress& progress);

  // Shots of the whole rig; `name`: "naked" or "dressed".
  std::map<std::string, Shot> shoot(const RayScene& world, const Body& body, const std::string& name);

  // Shots of the board before every sensor, in an otherwise empty room.
  Boards boards(const BoardsSpec& spec, const std::vector<RaySurface>& around);

  // Depth along a path of the hand-held sensor.
  DepthScan scan(const RayScene& world, const std::vector<Isometry3d>& path, const std::string& name);

  // True labels at colour size, by sensor.
  std::map<std::string, cv::Mat> labels(const RayScene& world) const;

 private:
  static Isometry3d world_from_color(const SensorSpec& sensor);
  SensorFrame measure(const IrView& view, Seed seed) const;
  // `body`: whom the sensor tracks, if it does; null: nobody is there.
  Shot shot(const RayScene& world, const IndirectLight& indirect, const Body* body, const SensorSpec& sensor,
            const SensorRays& rays, Seed seed) const;

  const Scene& scene_;
  Seed seed_;
  const SensorModel::Entry& model_;
  Meter meter_;
  Lighting lighting_;
  float exposure_;
  std::vector<SensorRays> rays_;
};

}  // namespace dressform
