#include "synthetic/operator/border_picks.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dressform {
namespace {

constexpr int kTopPoints = 243, kBottomPoints = 271;  // thesis, section 3.5
constexpr int kLeastPoints = 8;                       // of one border
constexpr double kStep_m = 0.004;                     // of height, between the rays that find a border
constexpr double kReach_m = 0.6;                      // from a garment's middle to its cloth
constexpr double kToRim_m = 0.08;                     // a border that ends nearer than this to a rim goes on to it
constexpr double kCrotch_m = 0.015;                   // half the width of the strip in which the crotch is looked for

using Line = std::vector<Vector3d>;

Vector3d centroid(const Line& points) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

// A horizontal unit vector; 0: to the front, 90: to the wearer's left.
Vector3d towards(double azimuth_deg) {
  const double azimuth = azimuth_deg * M_PI / 180;
  return {std::sin(azimuth), 0, std::cos(azimuth)};
}

// The cloth that rays from the axis strike first, from below upwards.
Line wall(const RayScene& cloth, const RisingAxis& axis, double azimuth_deg, double low_m, double high_m) {
  Line line;
  for (double y = low_m; y <= high_m; y += kStep_m)
    if (const auto hit = struck(cloth, axis.at(y), towards(azimuth_deg), kReach_m)) line.push_back(hit->point);
  return line;
}

void end_at(Line& line, const Line& rim, bool front) {
  if (line.empty()) return;
  const Vector3d& end = front ? line.front() : line.back();
  const Vector3d& on_rim = nearest(rim, end);
  if ((on_rim - end).norm() < kToRim_m) line.insert(front ? line.begin() : line.end(), on_rim);
}

const Line* line_of(const Garment& garment, const char* rim) {
  const TruthRim* found = rim_named(garment, rim);
  return found ? &found->points : nullptr;
}

double extreme_y(const Line& points, bool highest) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y() < b.y(); });
  return highest ? high->y() : low->y();
}

struct Corner {
  const char* name;
  double azimuth_deg;
};
constexpr Corner kCorners[] = {{"front_left", 45}, {"front_right", -45}, {"back_left", 135}, {"back_right", -135}};

using Borders = std::map<std::string, Line>;

// Shirts, dresses, skirts: from the lowest rim to the highest.
Borders borders_of_trunk(const RayScene& cloth, const Line& upper, const Line& lower) {
  const RisingAxis axis{{centroid(lower), centroid(upper)}};
  Borders borders;
  for (const auto& corner : kCorners) {
    Line& line = borders[corner.name] =
        wall(cloth, axis, corner.azimuth_deg, extreme_y(lower, false), extreme_y(upper, true));
    end_at(line, lower, true);
    end_at(line, upper, false);
  }
  return borders;
}

// Height of the lowest cloth between the legs.
std::optional<double> crotch_height(const Mesh& mesh, double middle_x) {
  std::optional<double> lowest;
  for (const auto& v : mesh.vertices)
    if (std::abs(v.x() - middle_x) < kCrotch_m) lowest = std::min(v.y(), lowest.value_or(v.y()));
  return lowest;
}

// Middle of the cloth of one leg just below the crotch; `side`: 1 left, -1 right.
Vector3d leg_top(const Mesh& mesh, double crotch, double middle_x, double side) {
  Line cloth;
  for (const auto& v : mesh.vertices)
    if (v.y() < crotch && v.y() > crotch - 0.04 && side * (v.x() - middle_x) > 0) cloth.push_back(v);
  return cloth.empty() ? Vector3d(middle_x + 0.1 * side, crotch, 0) : centroid(cloth);
}

Borders borders_of_trousers(const RayScene& cloth, const Mesh& mesh, const Line& waist, const Line& left,
                            const Line& right) {
  const Vector3d middle = centroid(waist);
  const auto crotch = crotch_height(mesh, middle.x());
  Borders borders;
  if (!crotch) return borders;
  Line inner;
  for (const double side : {1.0, -1.0}) {
    const Line& ankle = side > 0 ? left : right;
    const RisingAxis leg{{centroid(ankle), leg_top(mesh, *crotch, middle.x(), side), middle}};
    for (const auto& corner : kCorners) {
      if (side * corner.azimuth_deg < 0) continue;
      Line& line = borders[corner.name] =
          wall(cloth, leg, corner.azimuth_deg, extreme_y(ankle, false), extreme_y(waist, true));
      end_at(line, ankle, true);
      end_at(line, waist, false);
    }
    Line inside = wall(cloth, leg, -90 * side, extreme_y(ankle, false), *crotch);
    const auto beyond = [&](const Vector3d& point) { return side * (point.x() - middle.x()) < 0; };
    inside.erase(std::remove_if(inside.begin(), inside.end(), beyond), inside.end());  // that is the other leg
    end_at(inside, ankle, true);
    if (side < 0) std::reverse(inside.begin(), inside.end());
    inner.insert(inner.end(), inside.begin(), inside.end());
  }
  borders["inner"] = inner;
  return borders;
}

Borders borders_of(const Garment& garment) {
  const RayScene cloth = alone(garment.textured.mesh);
  const Line *neck = line_of(garment, "neck"), *waist = line_of(garment, "waist"), *hem = line_of(garment, "hem");
  const Line *left = line_of(garment, "left_ankle"), *right = line_of(garment, "right_ankle");
  if (waist && left && right) return borders_of_trousers(cloth, garment.textured.mesh, *waist, *left, *right);
  if ((neck || waist) && hem) return borders_of_trunk(cloth, neck ? *neck : *waist, *hem);
  return {};
}

// A border that runs upwards, cut off where the cloth passes under another garment; nothing else is under one.
Line outside(const Line& line, const Seam& seam) {
  const bool hidden_above = seam.rim == "waist";
  Line result;
  for (const auto& point : line) {
    const auto level_distance = [&](const Vector3d& p) { return std::hypot(p.x() - point.x(), p.z() - point.z()); };
    const auto beside = std::min_element(seam.points.begin(), seam.points.end(), [&](const auto& a, const auto& b) {
      return level_distance(a) < level_distance(b);
    });
    if (hidden_above ? point.y() < beside->y() : point.y() > beside->y()) result.push_back(point);
  }
  end_at(result, seam.points, !hidden_above);
  return result;
}

}  // namespace

void pick_borders(const WornGarments& worn, const std::map<std::string, Seam>& seams, const Onlookers& eyes,
                  Picks& picks) {
  for (const auto& [slot, garment] : worn) {
    Borders borders = borders_of(*garment);
    std::vector<double> lengths;
    for (auto& [name, line] : borders) {
      const auto seam = seams.find(slot);
      if (seam != seams.end() && name != "inner") line = outside(line, seam->second);
      lengths.push_back(length_of(line, false));
    }
    const auto counts = shared_out(slot == "top" ? kTopPoints : kBottomPoints, lengths, kLeastPoints);
    std::size_t i = 0;
    for (const auto& [name, line] : borders) {
      const int count = counts[i++];
      if (line.size() < 2) continue;
      const std::string full = "border_" + slot + "_" + name;
      const Line points = resampled(line, false, count);
      const auto seen = eyes.best(points);
      const SensorSpec& sensor = eyes.main_one(seen);
      picks.points[full] = {in_frame_of(sensor, eyes.click(points, seen, full))};
    }
  }
}

}  // namespace dressform
