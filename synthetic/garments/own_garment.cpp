#include "synthetic/garments/own_garment.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "scenes/mesh_frame.h"

namespace dressform {
namespace {

bool is_top(const GarmentSpec& spec) { return spec.kind == "shirt" || spec.kind == "dress"; }

// Height of the upper edge of a kind of garment, as part of the stature: at the neck or at the waist.
double usual_top(const GarmentSpec& spec) { return is_top(spec) ? 0.85 : 0.6; }

// How far a box is from that of a garment on this body; infinite where nobody wears it so.
double misfit_on(const Box& cloth, const Box& body, const GarmentSpec& spec) {
  constexpr double kLeastHeight_m = 0.08, kLeastWidth_m = 0.12;  // a belt-like skirt of a small child
  constexpr double kAbove_m = 0.4, kBelow_m = 0.05;              // a hood or a collar; a hem that lies on the floor
  constexpr double kBeside_m = 0.8;                              // a wide skirt beyond the body's own breadth
  constexpr double kOffMiddle_m = 0.1;                           // of what has to go round the body's axis
  const Vector3d size = cloth.sizes();
  if (size.y() < kLeastHeight_m || std::max(size.x(), size.z()) < kLeastWidth_m) return INFINITY;
  if (cloth.max().y() > body.max().y() + kAbove_m || cloth.min().y() < body.min().y() - kBelow_m) return INFINITY;
  for (int axis : {0, 2}) {
    const double middle = body.center()[axis];
    if (cloth.min()[axis] > middle + kOffMiddle_m || cloth.max()[axis] < middle - kOffMiddle_m) return INFINITY;
    if (cloth.min()[axis] < body.min()[axis] - kBeside_m || cloth.max()[axis] > body.max()[axis] + kBeside_m)
      return INFINITY;
  }
  return std::abs(cloth.max().y() / body.max().y() - usual_top(spec));
}

struct Opening {
  std::vector<Vector3d> points;
  Vector3d middle = Vector3d::Zero();
  double length_m = 0;
  bool central = false;  // goes round the garment's middle plane
};

Opening opening_of(const Mesh& mesh, const std::vector<int>& loop, double middle_x) {
  Opening opening;
  double low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3d& p = mesh.vertices[loop[i]];
    opening.points.push_back(p);
    opening.middle += p / static_cast<double>(loop.size());
    opening.length_m += (mesh.vertices[loop[(i + 1) % loop.size()]] - p).norm();
    low = std::min(low, p.x());
    high = std::max(high, p.x());
  }
  opening.central = low < middle_x && high > middle_x;
  return opening;
}

// The largest piece's openings, the highest first.
std::vector<Opening> openings_of(const Mesh& mesh) {
  constexpr double kLeastGirth_m = 0.12;  // of a small child's wrist: buttonholes and slits are no openings
  double middle_x = 0;
  for (const Vector3d& v : mesh.vertices) middle_x += v.x() / static_cast<double>(mesh.vertices.size());
  std::vector<Opening> openings;
  for (const auto& loop : boundary_loops(mesh)) {
    openings.push_back(opening_of(mesh, loop, middle_x));
    if (openings.back().length_m < kLeastGirth_m) openings.pop_back();
  }
  std::stable_sort(openings.begin(), openings.end(),
                   [](const Opening& a, const Opening& b) { return a.middle.y() > b.middle.y(); });
  return openings;
}

// Openings at the sides, counted for each: the one that lies furthest out (of sleeves) or lowest (of legs) ends the
// limb.
void name_sides(const std::vector<Opening>& openings, const GarmentSpec& spec, double middle_x,
                std::vector<std::string>& names) {
  for (const double sign : {1.0, -1.0}) {
    int best = -1;
    double best_value = -INFINITY;
    for (int i = 0; i < static_cast<int>(openings.size()); ++i) {
      const double off = sign * (openings[i].middle.x() - middle_x);
      if (openings[i].central || off <= 0) continue;
      const double value = is_top(spec) ? off : -openings[i].middle.y();
      if (value <= best_value) continue;
      best = i;
      best_value = value;
    }
    if (best >= 0) names[best] = std::string(sign > 0 ? "left_" : "right_") + (is_top(spec) ? "cuff" : "ankle");
  }
}

std::vector<std::string> names_of(const std::vector<Opening>& openings, const GarmentSpec& spec) {
  std::vector<std::string> names(openings.size());
  std::vector<int> central;
  double middle_x = 0, weight = 0;
  for (int i = 0; i < static_cast<int>(openings.size()); ++i)
    if (openings[i].central) {
      central.push_back(i);
      middle_x += openings[i].middle.x();
      ++weight;
    }
  if (weight > 0) middle_x /= weight;
  if (!central.empty()) names[central.front()] = is_top(spec) ? "neck" : "waist";
  if (central.size() > 1) names[central.back()] = "hem";
  name_sides(openings, spec, middle_x, names);
  int others = 1;
  for (auto& name : names)
    if (name.empty()) name = fmt::format("opening_{}", ++others);
  return names;
}

// What is likely wrong with a mesh that lacks openings.
std::string likely_cause(const MendedMesh& mesh, const std::vector<Opening>& openings, const Box& box) {
  double whole = 0;
  for (double area : mesh.area_m2) whole += area;
  constexpr double kMostOfIt = 0.6;  // of the cloth's area, in the largest piece
  if (mesh.area_m2.front() < kMostOfIt * whole)
    return fmt::format(
        "; {} pieces that only touch, the largest has {:.0f} % of the cloth: join their seams (vertices "
        "within 0.1 mm are joined)",
        mesh.area_m2.size(), 100 * mesh.area_m2.front() / whole);
  if (openings.empty()) return "; closed all round: cloth of two layers, joined at the rims? Leave the inner one out";
  for (const Opening& opening : openings) {
    Box reach;
    for (const Vector3d& p : opening.points) reach.extend(p);
    constexpr double kFromTopToBottom = 0.7;  // of the garment's height
    if (reach.sizes().y() > kFromTopToBottom * box.sizes().y())
      return fmt::format(
          "; one opening reaches from y = {:.2f} to {:.2f} m: open in front? Close it (join the two edges)",
          reach.min().y(), reach.max().y());
  }
  return "";
}

void check_openings(const MendedMesh& mesh, const Mesh& largest, const std::vector<Opening>& openings,
                    const std::vector<std::string>& names, const GarmentSpec& spec) {
  std::vector<std::string> wanted{is_top(spec) ? "neck" : "waist", "hem"};
  if (spec.kind == "trousers") wanted = {"waist", "left_ankle", "right_ankle"};
  const auto is_there = [&](const std::string& name) { return std::count(names.begin(), names.end(), name) > 0; };
  if (std::all_of(wanted.begin(), wanted.end(), is_there)) return;
  std::string found;
  for (std::size_t i = 0; i < openings.size(); ++i)
    found += fmt::format("{}{} at ({:.2f}, {:.2f}, {:.2f}) m, {:.2f} m round", i ? "; " : ": ", names[i],
                         openings[i].middle.x(), openings[i].middle.y(), openings[i].middle.z(), openings[i].length_m);
  std::string expected;
  for (const auto& name : wanted) expected += (expected.empty() ? "" : ", ") + name;
  throw InputError(spec.mesh.string(),
                   fmt::format("found {} openings of a {}{}; expected {}{}", openings.size(), spec.kind, found,
                               expected, likely_cause(mesh, openings, bounding_box(largest))));
}

}  // namespace

void check_lies_on(const Mesh& mesh, const GarmentSpec& spec, const Body& body) {
  const Box cloth = bounding_box(mesh), skin = bounding_box(body.mesh);
  const auto misfit = [&](const Box& box) { return misfit_on(box, skin, spec); };
  if (std::isfinite(misfit(cloth))) return;
  const Vector3d size = cloth.sizes();
  throw InputError(spec.mesh.string(),
                   fmt::format("found a {} {:.3g} m high, {:.3g} wide and {:.3g} deep, from y = {:.3g} to {:.3g} m and "
                               "about x = {:.3g}, z = {:.3g} m; expected it on the body (y = {:.3g} to {:.3g} m, x = "
                               "{:.3g}, z = {:.3g} m), in metres with y up{}",
                               spec.kind, size.y(), size.x(), size.z(), cloth.min().y(), cloth.max().y(),
                               cloth.center().x(), cloth.center().z(), skin.min().y(), skin.max().y(),
                               skin.center().x(), skin.center().z(), likely_frame(cloth, spec.frame, misfit)));
}

std::vector<TruthRim> rims_of_garment(const MendedMesh& mesh, const GarmentSpec& spec) {
  const Mesh largest = piece_of(mesh, 0);
  std::vector<Opening> openings = openings_of(largest);
  const std::vector<std::string> names = names_of(openings, spec);
  check_openings(mesh, largest, openings, names, spec);
  std::vector<TruthRim> rims;
  for (std::size_t i = 0; i < openings.size(); ++i) rims.push_back({names[i], 0, std::move(openings[i].points)});
  return rims;
}

}  // namespace dressform
