#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/imaging/depth_map.h"
#include "pipeline/registration/registration.h"

namespace dressform {

// One naked view as registration sees it: points of the mannequin, of the floor, and of the rest of the room.
struct ViewPoints {
  std::string sensor;
  DepthMap map;
  double noise_factor = 1;                      // of the sensor over the usual curve, by this shot
  double body_sigma_m = 0;                      // middle of the mannequin's points' noise
  std::vector<int> body, floor, room;           // indices into the map, evenly thinned to the asked numbers
  std::optional<Eigen::Vector4d> floor_plane;   // sensor frame, (n, d), n pointing up
  std::optional<Isometry3d> world_from_sensor;  // prior
  bool usable() const { return body.size() >= 60; }
};

// The naked shot of every sensor of the session that has one. Where extraction found no mannequin, its mask is taken to
// be what stands above the floor within 0.8 m of the crossing of the prior's optical axes, or without a prior of what
// lies in the middle of the image. A sensor without shot or calibration gives a view that is not usable.
std::vector<ViewPoints> view_points(const CaptureSession& session, const Calibration& calibration,
                                    const ExtractedViews& extracted, int most_points);

}  // namespace dressform
