#pragma once
#include <vector>

#include "scenes/scene.h"

namespace dressform {

// Where a hand-held sensor stands in each frame (IR camera, world_from_sensor): once round the body with some overlap,
// rising and stooping so that head, feet, floor and undersides are seen, with the jitter of a hand. `body_height_m`:
// stature of the one in the middle.
std::vector<Isometry3d> make_scan_path(const ScanSpec& scan, double body_height_m, Seed seed);

// Rig prior: the true poses turned about a random axis and moved along another, by normal amounts cut at twice sigma.
std::map<std::string, Isometry3d> perturbed_rig(const std::vector<SensorSpec>& rig, const PriorSpec& prior, Seed seed);

}  // namespace dressform
