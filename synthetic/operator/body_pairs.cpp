#include "synthetic/operator/body_pairs.h"

#include <algorithm>
#include <cmath>

#include "scenes/pick_names.h"
#include "scenes/random.h"
#include "synthetic/operator/clicks.h"

namespace dressform {
namespace {

constexpr double kTrunkReach_m = 0.45, kLimbReach_m = 0.25;  // from an axis to the skin
constexpr int kTrunkAngles = 10, kLimbAngles = 4;
constexpr std::size_t kFrameStep = 6;        // of the frames of a walk, which look at a body from all sides
constexpr double kOwnSurface_m = 0.004;      // what lies nearer to a point than this is the skin it lies on
const double kLegParts[] = {0.2, 0.5, 0.8};  // of the thigh, and of the lower leg
const double kArmParts[] = {0.35, 0.75};     // of the upper arm, and of the forearm

using Places = std::vector<std::optional<Struck>>;  // the same places in the same order on every body

Vector3d joint(const Body& body, const std::string& name) { return body.joints.at(name); }

// Where the trunk is marked: heights between its landmarks.
std::vector<double> trunk_heights(const BodyLandmarks& m) {
  std::vector<double> heights;
  const auto add = [&](double low, double high, int count) {
    for (int i = 0; i < count; ++i) heights.push_back(low + (high - low) * (i + 0.5) / count);
  };
  add(m.crotch, m.hip, 2);
  add(m.hip, m.waist, 3);
  add(m.waist, m.chest, 3);
  add(m.chest, m.shoulder, 3);
  add(m.shoulder, m.neck, 1);
  return heights;
}

void mark_trunk(const Body& body, const RayScene& skin, Places& places) {
  const RisingAxis middle{
      {joint(body, "SpineBase"), joint(body, "SpineMid"), joint(body, "SpineShoulder"), joint(body, "Neck")}};
  for (const double y : trunk_heights(body.landmarks))
    for (int k = 0; k < kTrunkAngles; ++k) {
      const double azimuth = 2 * M_PI * (k + 0.5) / kTrunkAngles;
      places.push_back(struck(skin, middle.at(y), Vector3d(std::sin(azimuth), 0, std::cos(azimuth)), kTrunkReach_m));
    }
}

// Round a limb's bone, from one joint to the next.
template <std::size_t N>
void mark_bone(const Vector3d& from, const Vector3d& to, const double (&parts)[N], const RayScene& skin,
               Places& places) {
  const Vector3d along = (to - from).normalized();
  const Vector3d front = (Vector3d::UnitZ() - along.z() * along).normalized(), side = along.cross(front);
  for (const double part : parts)
    for (int k = 0; k < kLimbAngles; ++k) {
      const double angle = 2 * M_PI * k / kLimbAngles;
      places.push_back(
          struck(skin, from + part * (to - from), std::cos(angle) * front + std::sin(angle) * side, kLimbReach_m));
    }
}

Places places_on(const Body& body, const RayScene& skin) {
  Places places;
  mark_trunk(body, skin, places);
  for (const std::string side : {"Left", "Right"}) {
    Vector3d hip = joint(body, "Hip" + side);
    const Vector3d knee = joint(body, "Knee" + side), ankle = joint(body, "Ankle" + side);
    hip += (knee - hip) * std::clamp((hip.y() - body.landmarks.crotch) / (hip.y() - knee.y()), 0.0, 0.5);
    mark_bone(hip, knee, kLegParts, skin, places);
    mark_bone(knee, ankle, kLegParts, skin, places);
    mark_bone(joint(body, "Shoulder" + side), joint(body, "Elbow" + side), kArmParts, skin, places);
    mark_bone(joint(body, "Elbow" + side), joint(body, "Wrist" + side), kArmParts, skin, places);
  }
  return places;
}

bool seen_on_walk(const RayScene& skin, const Struck& place, const std::vector<Isometry3d>& path) {
  for (std::size_t i = 0; i < path.size(); i += kFrameStep) {
    const Vector3d eye = path[i].translation(), sight = place.point - eye;
    if (sight.dot(place.normal) >= 0) continue;
    const double free = sight.norm() - kOwnSurface_m;
    if (!struck(skin, eye, sight.normalized(), free)) return true;
  }
  return false;
}

PickedPoints clicked_on(const std::vector<Struck>& places, const ScannedBody& scanned, const char* frame,
                        const char* name, double click_mm, Seed seed) {
  PickedPoints picked{frame, {}};
  const auto stream = stream_of((std::string("operator/") + name).c_str());
  for (std::size_t i = 0; i < places.size(); ++i)
    picked.points.push_back(scanned.path.front().inverse() *
                            clicked(places[i].point, places[i].normal, 1e-3 * click_mm, seed, stream, i));
  return picked;
}

}  // namespace

void pick_body_pairs(const ScannedBody& naked, const ScannedBody& user, double click_mm, Seed seed, Picks& picks) {
  const RayScene naked_skin = alone(naked.body.mesh), user_skin = alone(user.body.mesh);
  const Places on_naked = places_on(naked.body, naked_skin), on_user = places_on(user.body, user_skin);
  std::vector<Struck> controls, targets;
  for (std::size_t i = 0; i < on_naked.size(); ++i) {
    if (!on_naked[i] || !on_user[i] || !seen_on_walk(naked_skin, *on_naked[i], naked.path) ||
        !seen_on_walk(user_skin, *on_user[i], user.path))
      continue;
    controls.push_back(*on_naked[i]);
    targets.push_back(*on_user[i]);
  }
  if (static_cast<int>(controls.size()) < least_points("control")) return;
  picks.points["control"] = {clicked_on(controls, naked, kNakedScanFrame, "control", click_mm, seed)};
  picks.points["target"] = {clicked_on(targets, user, kUserScanFrame, "target", click_mm, seed)};
}

}  // namespace dressform
