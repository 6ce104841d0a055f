#include "synthetic/operator/rim_picks.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr int kTopPoints = 247, kBottomPoints = 162;  // thesis, section 3.4.2
constexpr int kLeastPoints = 12;                      // of one rim
constexpr double kHidden = 0.5;      // a rim of which less is seen lies under another garment, if there is one
constexpr double kLeastSeen = 0.25;  // of a rim's length, else nobody could say where it is
constexpr int kTangentSteps = 3;     // points that the eye takes an arc's direction from

// A closed path, and which sensor sees each point (-1: none).
struct SeenPath {
  std::vector<Vector3d> points;
  std::vector<int> eyes;
  double seen() const {
    return 1 - static_cast<double>(std::count(eyes.begin(), eyes.end(), -1)) / static_cast<double>(eyes.size());
  }
};

// Where the rim of `cover` hides the cloth of `garment`: the cloth's own points nearest to that rim.
SeenPath under(const Garment& garment, const TruthRim& cover, int count, const Onlookers& eyes) {
  SeenPath path{resampled(cover.points, true, count), {}};
  path.eyes = eyes.best(path.points);
  for (auto& point : path.points) point = nearest(garment.textured.mesh.vertices, point);
  return path;
}

// A cubic from `a` to `b` with unit tangents there, as long as a circle's arc would be.
Vector3d on_arc(const Vector3d& a, const Vector3d& b, const Vector3d& at_a, const Vector3d& at_b, double t) {
  const double quarter = 0.25 * std::acos(std::clamp(at_a.dot(at_b), -0.999, 0.999));
  const double speed = (b - a).norm() * 2 * std::tan(quarter) / std::sin(2 * quarter);
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * speed * at_a + (3 * t2 - 2 * t3) * b +
         (t3 - t2) * speed * at_b;
}

// Puts what no sensor sees on arcs between what is seen on either side.
void bridge(SeenPath& path) {
  const int n = static_cast<int>(path.points.size());
  const auto at = [n](int i) { return static_cast<std::size_t>((i % n + n) % n); };
  // The direction of the path where it is seen next to `i`, on the side of `step`, away from the gap.
  const auto heading = [&](int i, int step) -> Vector3d {
    int k = 0;
    while (k < kTangentSteps && path.eyes[at(i + (k + 1) * step)] >= 0) ++k;
    return path.points[at(i + k * step)] - path.points[at(i)];
  };
  const std::vector<Vector3d> picked = path.points;
  for (int i = 0; i < n; ++i) {
    if (path.eyes[at(i)] < 0 || path.eyes[at(i + 1)] >= 0) continue;  // no gap begins here
    int end = i + 1;                                                  // the next point that is seen
    while (path.eyes[at(end)] < 0) ++end;
    const Vector3d &a = picked[at(i)], &b = picked[at(end)], chord = (b - a).normalized();
    const Vector3d before = -heading(i, -1), after = heading(end, 1);
    const Vector3d at_a = before.norm() > 0 ? before.normalized() : chord;
    const Vector3d at_b = after.norm() > 0 ? after.normalized() : chord;
    for (int k = i + 1; k < end; ++k)
      path.points[at(k)] = on_arc(a, b, at_a, at_b, static_cast<double>(k - i) / (end - i));
  }
}

void pick(const std::string& name, SeenPath path, const Onlookers& eyes, Picks& picks) {
  const SensorSpec& sensor = eyes.main_one(path.eyes);
  path.points = eyes.click(path.points, path.eyes, name);
  bridge(path);
  picks.points[name] = {in_frame_of(sensor, std::move(path.points))};
}

}  // namespace

void pick_rims(const WornGarments& worn, const Onlookers& eyes, Picks& picks, std::map<std::string, Seam>& seams) {
  for (const auto& [slot, garment] : worn) {
    std::vector<double> lengths;
    for (const auto& rim : garment->rims) lengths.push_back(length_of(rim.points, true));
    const auto counts = shared_out(slot == "top" ? kTopPoints : kBottomPoints, lengths, kLeastPoints);
    const auto other = worn.find(slot == "top" ? "bottom" : "top");
    for (std::size_t i = 0; i < garment->rims.size(); ++i) {
      const TruthRim& rim = garment->rims[i];
      SeenPath path{resampled(rim.points, true, counts[i]), {}};
      path.eyes = eyes.best(path.points);
      const bool at_trunk = rim.name == "waist" || rim.name == "hem";
      const auto* cover =
          at_trunk && other != worn.end() ? rim_named(*other->second, rim.name == "waist" ? "hem" : "waist") : nullptr;
      if (cover && path.seen() < kHidden) {
        path = under(*garment, *cover, counts[i], eyes);
        seams[slot] = {rim.name, path.points};
      }
      if (path.seen() >= kLeastSeen) pick("rim_" + slot + "_" + rim.name, std::move(path), eyes, picks);
    }
  }
}

}  // namespace dressform
