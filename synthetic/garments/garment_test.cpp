#include "synthetic/garments/garment.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <set>

#include "scenes/error.h"
#include "scenes/mesh_io.h"
#include "synthetic/garments/drape/cloth.h"
#include "synthetic/garments/print.h"
#include "synthetic/geometry/self_intersection.h"
#include "synthetic/geometry/surface_distance.h"

namespace dressform {
namespace {

GarmentSpec garment(const std::string& kind, double sleeve_or_length, const std::string& print = "plain") {
  GarmentSpec spec;
  spec.kind = kind;
  spec.slot = kind == "shirt" ? "top" : "bottom";
  spec.sleeve = spec.length = sleeve_or_length;
  spec.ease_m = 0.08;
  spec.print.kind = print;
  spec.cloth_edge_m = 0.010;  // coarser than usual, for time
  return spec;
}

GarmentSpec with_collar(GarmentSpec spec, const std::string& collar) {
  spec.collar = collar;
  return spec;
}

BodySpec woman() {
  BodySpec spec;
  spec.sex = "female";
  spec.stature_m = 1.64;
  spec.chest_m = 0.95;
  spec.waist_m = 0.80;
  spec.hip_m = 1.02;
  return spec;
}

BodySpec sampled(const std::string& who, int seed) {
  BodySpec spec;
  spec.sample = who;
  spec.sample_seed = seed;
  return spec;
}

BodySpec stout_man() {
  BodySpec spec;
  spec.stature_m = 1.73;
  spec.chest_m = 1.13;
  spec.waist_m = 1.02;
  spec.hip_m = 1.07;
  spec.arm_angle_deg = 20;
  return spec;
}

struct Outfit {
  const char* name;
  BodySpec body;
  GarmentSpec bottom, top;
};

class Outfits : public testing::TestWithParam<Outfit> {};

void expect_well_cut(const Garment& garment, const std::vector<std::string>& names) {
  const Mesh& mesh = garment.textured.mesh;
  const Topology shape = topology(mesh);
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.non_manifold_edges, 0);
  EXPECT_EQ(shape.loops, static_cast<int>(names.size()));
  EXPECT_EQ(shape.euler(), 2 - static_cast<int>(names.size()));  // genus 0
  EXPECT_EQ(shape.boundary_edges, 2 * shape.vertices - shape.triangles - 2 * shape.euler());
  std::set<std::array<double, 3>> rim_vertices;
  for (const auto& loop : boundary_loops(mesh))
    for (int i : loop) rim_vertices.insert({mesh.vertices[i].x(), mesh.vertices[i].y(), mesh.vertices[i].z()});
  ASSERT_EQ(garment.rims.size(), names.size());
  size_t points = 0;
  for (size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(garment.rims[i].name, names[i]);
    points += garment.rims[i].points.size();
    for (const Vector3d& p : garment.rims[i].points) EXPECT_TRUE(rim_vertices.count({p.x(), p.y(), p.z()}));
  }
  EXPECT_EQ(points, rim_vertices.size());
}

// Every vertex, edge middle and triangle middle.
void expect_clear(const Mesh& cloth, const Mesh& surface, double clearance_m) {
  const SurfaceDistance tree(surface);
  double worst = 1;
  const auto look = [&](const Vector3d& p) {
    const auto near = tree.closest(p, 0.03);
    if (!near.found) return;
    worst = std::min(worst, near.height);
  };
  for (const Vector3i& t : cloth.triangles) {
    const Vector3d &a = cloth.vertices[t[0]], &b = cloth.vertices[t[1]], &c = cloth.vertices[t[2]];
    for (const Vector3d& p : {a, Vector3d(0.5 * (a + b)), Vector3d((a + b + c) / 3)}) look(p);
  }
  EXPECT_GE(worst, clearance_m);
}

// Lies as cloth does: hardly stretched against its pattern, and nothing meets anything (exact predicates).
void expect_at_rest(const Garment& garment, const Mesh& body, const Mesh& under) {
  const Mesh& mesh = garment.textured.mesh;
  Cloth cloth;
  cloth.features = features_of(mesh.triangles);
  cloth.rest_m = garment.rest_m;
  ASSERT_EQ(cloth.rest_m.size(), cloth.features.edges.size());
  EXPECT_LE(strain_quantile(cloth, mesh.vertices, 0.95), 0.05);
  EXPECT_GT(strain_quantile(cloth, mesh.vertices, 0.95), 0.001);  // it did move
  EXPECT_EQ(garment.rest.strain_p95, strain_quantile(cloth, mesh.vertices, 0.95));
  EXPECT_TRUE(garment.rest.settled) << garment.rest.speed_m_per_s;
  EXPECT_EQ(self_intersections(mesh), 0);
  EXPECT_TRUE(crossing_triangles(mesh, body).empty());
  EXPECT_TRUE(crossing_triangles(mesh, under).empty());
}

void expect_readable(const TexturedMesh& textured) {
  ASSERT_EQ(textured.corner_uv.size(), textured.mesh.triangles.size());
  ASSERT_FALSE(textured.texture.empty());
  double mirrored = 0, all = 0;
  for (size_t i = 0; i < textured.corner_uv.size(); ++i) {
    const auto& uv = textured.corner_uv[i];
    for (const Vector2f& q : uv) {
      ASSERT_GE(q.minCoeff(), 0.f);
      ASSERT_LE(q.maxCoeff(), 1.f);
    }
    const Vector2f a = uv[1] - uv[0], b = uv[2] - uv[0];
    const Vector3i& t = textured.mesh.triangles[i];
    const auto& v = textured.mesh.vertices;
    const double area = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).norm();
    // Counter-clockwise seen from outside is clockwise where v grows downwards.
    if (a.x() * b.y() - a.y() * b.x() > 0) mirrored += area;
    all += area;
  }
  EXPECT_LT(mirrored, 0.01 * all);
}

double lowest(const std::vector<Vector3d>& points) {
  double low = 9;
  for (const Vector3d& p : points) low = std::min(low, p.y());
  return low;
}

double highest(const std::vector<Vector3d>& points) {
  double high = -9;
  for (const Vector3d& p : points) high = std::max(high, p.y());
  return high;
}

// A polo collar rises about the neck and comes down again outside; a hood covers the crown and leaves the face free.
void expect_collar(const Garment& top, const std::string& collar, const Body& body) {
  const auto& cloth = top.textured.mesh.vertices;
  const auto& rim = top.rims[0].points;
  const auto part = [](const std::vector<Vector3d>& points, const auto& keep) {
    std::vector<Vector3d> kept;
    std::copy_if(points.begin(), points.end(), std::back_inserter(kept), keep);
    return kept;
  };
  if (collar == "polo") {
    const auto behind = [](const Vector3d& p) { return p.z() < -0.06; };
    EXPECT_LT(highest(part(rim, behind)), highest(part(cloth, behind)) - 0.025);
    EXPECT_LT(highest(cloth), body.landmarks.neck + 0.10);
    const auto slit = [](const Vector3d& p) { return std::abs(p.x()) < 0.03 && p.z() > 0; };
    EXPECT_LT(lowest(part(rim, slit)), lowest(part(rim, behind)) - 0.05);
  } else {
    EXPECT_GT(highest(cloth), body.landmarks.stature);
    EXPECT_GT(highest(rim), body.landmarks.stature - 0.09);  // above the eyes
    const auto face = [&](const Vector3d& p) {               // eyes to throat
      return std::abs(p.x()) < 0.03 && p.z() > 0.02 && p.y() < body.landmarks.stature - 0.09 &&
             p.y() > body.landmarks.neck + 0.02;
    };
    EXPECT_TRUE(part(cloth, face).empty());
  }
}

TEST_P(Outfits, FitOutsideTheBodyWithExactRims) {
  const Outfit& outfit = GetParam();
  const Body body = make_body(outfit.body);
  std::vector<Garment> worn{make_garment(outfit.bottom, body, {}, 7)};
  worn.push_back(make_garment(outfit.top, body, worn, 7));
  if (outfit.bottom.kind == "trousers")
    expect_well_cut(worn[0], {"waist", "left_ankle", "right_ankle"});
  else
    expect_well_cut(worn[0], {"waist", "hem"});
  expect_well_cut(worn[1], {"neck", "left_cuff", "right_cuff", "hem"});
  expect_at_rest(worn[0], body.mesh, {});
  expect_at_rest(worn[1], body.mesh, worn[0].textured.mesh);
  for (const Garment& each : worn) {
    expect_clear(each.textured.mesh, body.mesh, 0.002);
    expect_readable(each.textured);
  }
  if (outfit.top.collar != "none") expect_collar(worn[1], outfit.top.collar, body);
}

const Outfit kOutfits[] = {
    {"group1", {}, garment("trousers", 0.96), with_collar(garment("shirt", 0.42, "stars"), "polo")},
    {"group3", {}, garment("trousers", 0.97, "denim"), with_collar(garment("shirt", 0.96, "stripes"), "hood")},
    {"group4", {}, garment("skirt", 0.48), garment("shirt", 0.42, "stars")},
    {"woman", woman(), garment("trousers", 0.5), with_collar(garment("shirt", 0.3, "complex"), "polo")},
    {"sampled_woman", sampled("woman", 3), garment("skirt", 0.7), with_collar(garment("shirt", 0.9, "plaid"), "hood")},
    {"sampled_man", sampled("man", 2), garment("trousers", 1.0), with_collar(garment("shirt", 0.5), "polo")},
    {"stout_man", stout_man(), garment("trousers", 0.55), with_collar(garment("shirt", 0.42), "hood")},
};

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

INSTANTIATE_TEST_SUITE_P(Garments, Outfits, testing::ValuesIn(kOutfits),
                         [](const auto& info) { return std::string(info.param.name); });

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

TEST(Garment, IsTheSameForTheSameSeed) {
  const Body body = make_body({});
  const GarmentSpec spec = garment("skirt", 0.4);
  const Garment a = make_garment(spec, body, {}, 3), b = make_garment(spec, body, {}, 3),
                c = make_garment(spec, body, {}, 4);
  EXPECT_EQ(a.textured.mesh.vertices, b.textured.mesh.vertices);
  EXPECT_EQ(cv::norm(a.textured.texture, b.textured.texture, cv::NORM_INF), 0);
  EXPECT_NE(a.textured.mesh.vertices, c.textured.mesh.vertices);
  EXPECT_THROW(make_garment(garment("cape", 1), body, {}, 3), InputError);
}

TEST(Garment, OwnMeshIsPlacedAsGivenAndItsRimsNamed) {
  const Body body = make_body({});
  const Garment made = make_garment(garment("trousers", 0.9), body, {}, 3);
  const auto file = std::filesystem::path(testing::TempDir()) / "someones_trousers.glb";
  write_glb(file, made.textured);
  GarmentSpec spec = garment("trousers", 1);
  spec.mesh = file;
  const Garment read = make_garment(spec, body, {}, 3);
  EXPECT_EQ(read.textured.mesh.triangles.size(), made.textured.mesh.triangles.size());
  ASSERT_EQ(read.rims.size(), 3u);
  std::set<std::string> names;
  for (const TruthRim& rim : read.rims) names.insert(rim.name);
  EXPECT_EQ(names, (std::set<std::string>{"waist", "left_ankle", "right_ankle"}));
}

TEST(Print, HasTheAskedSizeAndColours) {
  PrintSpec spec;
  for (const std::string kind :
       {"plain", "stars", "complex", "stripes", "plaid", "denim", "weave", "characters", "all_over", "noise"}) {
    spec.kind = kind;
    spec.colors = {"#204060", "#ffffff"};
    const cv::Mat picture = paint_print(spec, 0.5, 0.4, 1000, 5);
    EXPECT_EQ(picture.size(), cv::Size(500, 400)) << kind;
    EXPECT_EQ(cv::norm(picture, paint_print(spec, 0.5, 0.4, 1000, 5), cv::NORM_INF), 0) << kind;
    cv::Scalar mean, deviation;
    cv::meanStdDev(picture, mean, deviation);
    EXPECT_GT(mean[0], mean[2]) << kind;  // bluish ground, BGR
    EXPECT_GT(deviation[0], 0.5) << kind;
  }
  spec.kind = "zebra";
  EXPECT_THROW(paint_print(spec, 0.5, 0.4, 1000, 5), InputError);
  spec.kind = "plain";
  spec.colors = {"blue"};
  EXPECT_THROW(paint_print(spec, 0.5, 0.4, 1000, 5), InputError);
}

}  // namespace
}  // namespace dressform
