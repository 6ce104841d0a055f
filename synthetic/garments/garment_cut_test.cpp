#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <map>

#include "scenes/error.h"
#include "synthetic/garments/garment.h"
#include "synthetic/garments/garment_checks.h"

namespace dressform {
namespace {

// A dress, a wedge-shaped neckline, a hem that rises to the front, a shirt tucked into trousers worn low.
TEST(Garment, IsCutAsAsked) {
  GarmentSpec dress = garment("dress", 0.3);
  dress.length = 0.6;
  dress.neck = "v";
  dress.neck_depth_m = 0.15;
  dress.hem_slant = 0.2;
  const Body lady = make_body(sampled("woman", 4));
  const Garment worn = make_garment(dress, lady, {}, 2);
  expect_well_cut(worn, {"neck", "left_cuff", "right_cuff", "hem"});
  expect_at_rest(worn, lady.mesh, {});
  expect_readable(worn.textured);
  const auto forward = [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); };
  const auto [back, front] = std::minmax_element(worn.rims[3].points.begin(), worn.rims[3].points.end(), forward);
  EXPECT_GT(front->y(), back->y() + 0.02);
  dress.neck = "round";
  const auto lowest_at = [](const TruthRim& neck, double x) {
    double low = 9;
    for (const auto& p : neck.points)
      if (p.z() > -0.03 && std::abs(std::abs(p.x()) - x) < 0.012) low = std::min(low, p.y());
    return low;
  };
  // Half way out a round neckline is hardly higher than in the middle, a wedge is.
  const Garment round = make_garment(dress, lady, {}, 2);
  const double wedge_rise = lowest_at(worn.rims[0], 0.05) - lowest_at(worn.rims[0], 0);
  const double round_rise = lowest_at(round.rims[0], 0.05) - lowest_at(round.rims[0], 0);
  EXPECT_GT(wedge_rise, round_rise + 0.015);

  const Body man = make_body({});
  GarmentSpec shirt = garment("shirt", 0.4), trousers = garment("trousers", 0.9);
  shirt.tucked = true;
  trousers.waist_offset_m = -0.03;
  std::vector<Garment> layers{make_garment(shirt, man, {}, 2)};
  layers.push_back(make_garment(trousers, man, layers, 2));
  expect_well_cut(layers[0], {"neck", "left_cuff", "right_cuff", "hem"});
  expect_well_cut(layers[1], {"waist", "left_ankle", "right_ankle"});
  expect_at_rest(layers[0], man.mesh, {});
  expect_at_rest(layers[1], man.mesh, layers[0].textured.mesh);
  for (const auto& p : layers[1].rims[0].points) EXPECT_NEAR(p.y(), man.landmarks.waist - 0.045, 0.02);
  double hem = 0;
  for (const auto& p : layers[0].rims[3].points) hem = std::max(hem, p.y());
  EXPECT_LT(hem, man.landmarks.waist - 0.06);

  trousers.tucked = true;
  EXPECT_THROW(make_garment(trousers, man, {}, 2), InputError);
  trousers.tucked = false;
  trousers.collar = "polo";
  EXPECT_THROW(make_garment(trousers, man, {}, 2), InputError);
  shirt.collar = "hood";
  shirt.neck = "v";
  EXPECT_THROW(make_garment(shirt, man, {}, 2), InputError);
  GarmentSpec skirt = garment("skirt", 1.05);
  EXPECT_THROW(make_garment(skirt, man, {}, 2), InputError);
}

// Legs cut longer than the wearer's do not end lower by as much: they rest on the foot, above the floor, in folds.
TEST(Garment, LongTrousersBreakOnTheFoot) {
  const Body man = make_body({});
  GarmentSpec spec = garment("trousers", 1.06);
  spec.cloth_edge_m = 0.014;
  const Garment longer = make_garment(spec, man, {}, 2);
  expect_well_cut(longer, {"waist", "left_ankle", "right_ankle"});
  expect_at_rest(longer, man.mesh, {});
  const double excess = 0.06 * (man.landmarks.waist - man.landmarks.ankle);
  for (const int ankle : {1, 2}) {
    EXPECT_GT(lowest(longer.rims[ankle].points), 0.003);
    EXPECT_LT(lowest(longer.rims[ankle].points), man.landmarks.ankle - 0.01);
    EXPECT_GT(highest(longer.rims[ankle].points), man.landmarks.ankle - 0.8 * excess);
  }
}

// Checks on the back are as square as on the front, and the bands across meet at the side seams.
TEST(Garment, PrintRunsStraightOnFrontAndBack) {
  GarmentSpec spec = garment("shirt", 0.4, "plaid");
  spec.cloth_edge_m = 0.014;
  const Garment shirt = make_garment(spec, make_body({}), {}, 2);
  const TexturedMesh& textured = shirt.textured;
  const auto& v = textured.mesh.vertices;
  const Vector2d size(textured.texture.cols, textured.texture.rows);
  const auto place = [&](size_t t, int k) {
    return Vector2d(textured.corner_uv[t][k].cast<double>().cwiseProduct(size));
  };
  const auto below_arms = [&](size_t t) {
    double y = 0;
    for (int k = 0; k < 3; ++k) y += v[textured.mesh.triangles[t][k]].y() / 3;
    return y < 1.36 && y > 1.0 && std::abs(v[textured.mesh.triangles[t][0]].x()) < 0.19;
  };
  double sheared = 0, all = 0;
  std::map<std::pair<int, int>, Vector2d> at_edge;
  int seams = 0;
  for (size_t t = 0; t < textured.mesh.triangles.size(); ++t) {
    if (!below_arms(t)) continue;
    const Vector3i& corner = textured.mesh.triangles[t];
    const Vector3d a = v[corner[1]] - v[corner[0]], b = v[corner[2]] - v[corner[0]];
    Eigen::Matrix2d flat, printed;
    const Vector3d x = a.normalized(), y = a.cross(b).cross(a).normalized();
    flat << a.norm(), b.dot(x), 0, b.dot(y);
    printed << place(t, 1) - place(t, 0), place(t, 2) - place(t, 0);
    const Eigen::Vector2d stretch = Eigen::JacobiSVD<Eigen::Matrix2d>(printed * flat.inverse()).singularValues();
    all += a.cross(b).norm();
    if (stretch[0] > 1.4 * stretch[1]) sheared += a.cross(b).norm();
    for (int k = 0; k < 3; ++k) {
      const auto edge = std::minmax(corner[k], corner[(k + 1) % 3]);
      const Vector2d middle = 0.5 * (place(t, k) + place(t, (k + 1) % 3));
      const auto [other, is_new] = at_edge.emplace(edge, middle);
      const Vector2d jump = other->second - middle;
      if (is_new || std::abs(jump.x()) < 20 || std::abs(jump.y()) > 400) continue;  // no seam; to a sleeve
      ++seams;
      EXPECT_NEAR(other->second.y(), middle.y(), 6);  // 3 mm
    }
  }
  EXPECT_LT(sheared, 0.1 * all);
  EXPECT_GT(seams, 20);
}

// Nowhere does a cuff run up into the sleeve or over to the trunk: it is cut straight, and waves by a centimetre or two
// as it hangs.
TEST(Garment, CuffsGoRoundTheArmAlone) {
  BodySpec spec;
  spec.arm_angle_deg = 16;
  const Body body = make_body(spec);
  for (const double sleeve : {0.45, 1.0}) {
    const Garment shirt = make_garment(garment("shirt", sleeve), body, {}, 1);
    for (const TruthRim& rim : shirt.rims) {
      if (rim.name != "left_cuff" && rim.name != "right_cuff") continue;
      const std::string side = rim.name == "left_cuff" ? "Left" : "Right";
      const Eigen::Vector3d shoulder = body.joints.at("Shoulder" + side), wrist = body.joints.at("Wrist" + side);
      const Eigen::Vector3d axis = (wrist - shoulder).normalized();
      double least = 1e9, most = -1e9;
      for (const auto& p : rim.points) {
        least = std::min(least, axis.dot(p - shoulder));
        most = std::max(most, axis.dot(p - shoulder));
      }
      EXPECT_LT(most - least, 0.025) << rim.name << " of a sleeve of " << sleeve;
    }
  }
}

}  // namespace
}  // namespace dressform
