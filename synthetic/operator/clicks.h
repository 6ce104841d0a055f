#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/picks.h"
#include "scenes/scene.h"
#include "synthetic/capture/ray_scene.h"
#include "synthetic/garments/garment.h"

namespace dressform {

// What the parts of the operator share: paths, lines of sight, and how a hand misses.

// Equal steps along a line of points; a closed one ends a step before it begins. `count`: at least 2.
std::vector<Vector3d> resampled(const std::vector<Vector3d>& line, bool closed, int count);
double length_of(const std::vector<Vector3d>& line, bool closed);
// How many points each line gets of `count`, by length, at least `least` each.
std::vector<int> shared_out(int count, const std::vector<double>& lengths, int least);

// The point of a line's corners that lies nearest.
const Vector3d& nearest(const std::vector<Vector3d>& points, const Vector3d& to);

// The middle of a body or of cloth by height: straight between corners that rise.
struct RisingAxis {
  std::vector<Vector3d> corners;  // two at least
  Vector3d at(double y) const;    // at the height y; beyond the ends the end's x and z
};

// The garment's rim of that name; null where it has none.
const TruthRim* rim_named(const Garment& garment, const std::string& name);

// Points of the world as picked in the frame of a sensor (its infrared camera's).
PickedPoints in_frame_of(const SensorSpec& sensor, std::vector<Vector3d> points);

// Where `meant` is hit by a hand that misses by normal errors across `direction`, on each axis.
Vector3d clicked(const Vector3d& meant, const Vector3d& direction, double sigma_m, Seed seed, std::uint64_t stream,
                 std::uint64_t index);

// The sensors that look at the dressed mannequin.
class Onlookers {
 public:
  Onlookers(const RayScene& dressed, const std::vector<SensorSpec>& rig, double click_px, Seed seed);
  // For each point the nearest of the sensors that see it (an index into the rig), -1 where none does.
  std::vector<int> best(const std::vector<Vector3d>& points) const;
  // Points clicked on in the picture of the sensor that sees each; unseen ones as from the nearest sensor.
  std::vector<Vector3d> click(const std::vector<Vector3d>& points, const std::vector<int>& seen_by,
                              const std::string& name) const;
  // The sensor that most of the points are seen by: they are given in its frame. The first where none is.
  const SensorSpec& main_one(const std::vector<int>& seen_by) const;

 private:
  int nearest_sensor(const Vector3d& point) const;
  const RayScene& dressed_;
  const std::vector<SensorSpec>& rig_;
  double click_px_;
  Seed seed_;
};

// A mesh by itself, for rays.
RayScene alone(const Mesh& mesh);

struct Struck {
  Vector3d point, normal;  // of unit length, outward
};
// The first thing that a ray from `origin` along the unit vector `direction` strikes; nothing within `far_m`: nothing.
std::optional<Struck> struck(const RayScene& scene, const Vector3d& origin, const Vector3d& direction, double far_m);

}  // namespace dressform
