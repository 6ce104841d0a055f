#include "synthetic/body/body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "scenes/error.h"
#include "scenes/mesh_io.h"
#include "synthetic/body/body_measure.h"
#include "synthetic/body/section.h"
#include "synthetic/geometry/self_intersection.h"

namespace dressform {
namespace {

struct Build {
  const char* sex;
  double stature, chest, waist, hip;
};

BodySpec spec_of(const Build& build) {
  BodySpec spec;
  spec.sex = build.sex;
  spec.stature_m = build.stature;
  spec.chest_m = build.chest;
  spec.waist_m = build.waist;
  spec.hip_m = build.hip;
  return spec;
}

// The mannequin of the thesis, and builds from slim to stout.
const Build kBuilds[] = {
    {"male", 1.85, 1.01, 0.81, 0.91},   {"male", 1.76, 1.06, 0.94, 1.02},   {"male", 1.60, 0.92, 0.76, 0.90},
    {"male", 1.95, 1.20, 1.12, 1.18},   {"male", 1.70, 1.15, 1.10, 1.10},   {"male", 1.88, 0.95, 0.80, 0.95},
    {"female", 1.63, 0.95, 0.86, 1.02}, {"female", 1.55, 0.82, 0.68, 0.90}, {"female", 1.75, 0.92, 0.76, 1.00},
    {"female", 1.68, 1.12, 1.05, 1.18}, {"female", 1.80, 1.00, 0.90, 1.08}, {"female", 1.60, 0.88, 0.72, 0.94},
};

class Bodies : public testing::TestWithParam<Build> {};

TEST_P(Bodies, AreClosedAndMeasureWhatWasAsked) {
  const Build build = GetParam();
  const Body body = make_body(spec_of(build));
  const Topology shape = topology(body.mesh);
  EXPECT_TRUE(shape.closed());
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.euler(), 2);
  EXPECT_NEAR(tape_girth(body.mesh, body.landmarks.chest), build.chest, 1e-3);
  EXPECT_NEAR(tape_girth(body.mesh, body.landmarks.waist), build.waist, 1e-3);
  EXPECT_NEAR(tape_girth(body.mesh, body.landmarks.hip), build.hip, 1e-3);
  double low = 1, high = 0, volume = 0;
  for (const Vector3d& v : body.mesh.vertices) {
    low = std::min(low, v.y());
    high = std::max(high, v.y());
  }
  EXPECT_NEAR(low, 0, 1e-9);
  EXPECT_NEAR(high, build.stature, 1e-9);
  for (const Vector3i& t : body.mesh.triangles)
    volume += body.mesh.vertices[t[0]].dot(body.mesh.vertices[t[1]].cross(body.mesh.vertices[t[2]])) / 6;
  EXPECT_GT(volume, 0.03);  // outward
  EXPECT_LT(volume, 0.16);
  EXPECT_EQ(body.joints.size(), 25u);
}
INSTANTIATE_TEST_SUITE_P(Builds, Bodies, testing::ValuesIn(kBuilds));

TEST(Body, IsDeterministicAndFacesForward) {
  const Body a = make_body({}), b = make_body({});
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  // Feet point forward.
  double front = 0, back = 0;
  for (const Vector3d& v : a.mesh.vertices)
    if (v.y() < 0.05) {
      front = std::max(front, v.z());
      back = std::min(back, v.z());
    }
  EXPECT_GT(front, 1.4 * -back);
  EXPECT_GT(a.joints.at("HandLeft").x(), 0.2);
  EXPECT_LT(a.joints.at("HandRight").x(), -0.2);
}

TEST(Body, RefusesWhatNoBodyMeasures) {
  EXPECT_THROW(make_body(spec_of({"male", 2.60, 1.01, 0.81, 0.91})), InputError);
  EXPECT_THROW(make_body(spec_of({"male", 1.85, 0.50, 0.81, 0.91})), InputError);
  EXPECT_THROW(make_body(spec_of({"female", 1.65, 0.90, 1.40, 0.95})), InputError);
  EXPECT_THROW(make_body(spec_of({"male", 1.85, 1.01, 0.81, std::nan("")})), InputError);
  EXPECT_THROW(make_body(spec_of({"child", 1.20, 0.6, 0.6, 0.6})), InputError);
}

TEST(Body, SegmentsAreAsLongAsAsked) {
  BodySpec spec;
  spec.inseam_m = 0.895;
  spec.knee_height_m = 0.530;
  spec.upper_arm_m = 0.345;
  spec.forearm_m = 0.275;
  const Body body = make_body(spec);
  EXPECT_NEAR(measure_body(body.mesh, "body").landmarks.crotch, spec.inseam_m, 1e-3);
  EXPECT_NEAR(body.joints.at("KneeLeft").y(), spec.knee_height_m, 1e-3);
  const Vector3d shoulder = body.joints.at("ShoulderLeft"), elbow = body.joints.at("ElbowLeft");
  const double above =
      (body.landmarks.shoulder - shoulder.y()) * (shoulder.y() - elbow.y()) / (elbow - shoulder).norm();
  EXPECT_NEAR((elbow - shoulder).norm() + above, spec.upper_arm_m, 1e-3);
  EXPECT_NEAR((body.joints.at("WristLeft") - elbow).norm(), spec.forearm_m, 1e-3);
  EXPECT_NEAR(tape_girth(body.mesh, body.landmarks.waist), spec.waist_m, 1e-3);
  spec.inseam_m = 1.1;
  EXPECT_THROW(make_body(spec), InputError);
}

class Poses : public testing::TestWithParam<const char*> {};

TEST_P(Poses, AreClosedAndHoldTheArmsClear) {
  for (const char* sex : {"male", "female"}) {
    BodySpec spec = spec_of({sex, 1.70, 1.00, 0.90, 1.03});
    spec.pose = GetParam();
    const Body body = make_body(spec);
    const Topology shape = topology(body.mesh);
    EXPECT_TRUE(shape.closed());
    EXPECT_EQ(shape.components, 1);
    EXPECT_EQ(shape.euler(), 2);
    EXPECT_EQ(self_intersections(body.mesh), 0);
    EXPECT_NEAR(tape_girth(body.mesh, body.landmarks.hip), 1.03, 1e-3);
    // An arm on each side of the trunk.
    EXPECT_EQ(horizontal_section(body.mesh, body.landmarks.chest).size(), 3u);
  }
}
INSTANTIATE_TEST_SUITE_P(All, Poses, testing::Values("mannequin", "a_pose", "bent_arms", "one_arm_bent"));

TEST(Body, PosesDiffer) {
  BodySpec spec;
  const auto bend_deg = [&](const char* pose) {
    spec.pose = pose;
    const Body body = make_body(spec);
    const Vector3d upper = body.joints.at("ElbowLeft") - body.joints.at("ShoulderLeft");
    const Vector3d lower = body.joints.at("WristLeft") - body.joints.at("ElbowLeft");
    return std::acos(upper.normalized().dot(lower.normalized())) * 180 / M_PI;
  };
  EXPECT_NEAR(bend_deg("mannequin"), 8, 0.5);
  EXPECT_NEAR(bend_deg("a_pose"), 4, 0.5);
  EXPECT_NEAR(bend_deg("bent_arms"), 18, 0.5);
  EXPECT_THROW(bend_deg("headstand"), InputError);
}

// The foremost point in the middle between two heights, m; 0 where there is none.
double foremost(const Mesh& mesh, double low, double high) {
  double front = 0;
  for (const Vector3d& v : mesh.vertices)
    if (std::abs(v.x()) < 0.01 && v.y() > low && v.y() < high) front = std::max(front, v.z());
  return front;
}

void expect_closed(const Body& body) {
  const Topology shape = topology(body.mesh);
  EXPECT_TRUE(shape.closed());
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.euler(), 2);
}

TEST(Body, AChinJutsOutBeforeTheNeckAndANeckIsAsBroadAsAsked) {
  BodySpec spec;
  const Body usual = make_body(spec);
  spec.chin_m = 0.08;
  spec.bow_deg = 28;
  const Body jutting = make_body(spec);
  expect_closed(jutting);
  const double low = usual.landmarks.neck - 0.05, high = usual.landmarks.neck - 0.01;
  EXPECT_GT(foremost(jutting.mesh, low, high), foremost(usual.mesh, low, high) + 0.03);
  EXPECT_NEAR(tape_girth(jutting.mesh, jutting.landmarks.chest), spec.chest_m, 1e-3);
  spec = {};
  spec.neck_m = 0.46;
  const Body broad = make_body(spec);
  const auto neck_girth = [](const Body& body) { return tape_girth(body.mesh, body.landmarks.neck + 0.03); };
  EXPECT_GT(neck_girth(broad), neck_girth(usual) + 0.03);
  spec.neck_m = 0.8;
  EXPECT_THROW(make_body(spec), InputError);
}

TEST(Body, AHunchMovesTheNeckForwardAndKeepsTheGirths) {
  BodySpec spec;
  const Body upright = make_body(spec);
  spec.hunch_m = 0.09;
  const Body hunched = make_body(spec);
  expect_closed(hunched);
  EXPECT_NEAR(tape_girth(hunched.mesh, hunched.landmarks.chest), spec.chest_m, 1e-3);
  EXPECT_NEAR(hunched.joints.at("Neck").z() - upright.joints.at("Neck").z(), 0.09, 0.01);
  EXPECT_EQ(hunched.joints.at("KneeLeft"), upright.joints.at("KneeLeft"));
}

TEST(Body, OneArmIsBentAndTheOtherHangs) {
  BodySpec spec;
  const Body usual = make_body(spec);
  spec.pose = "one_arm_bent";
  const Body body = make_body(spec);
  EXPECT_EQ(body.joints.at("WristLeft"), usual.joints.at("WristLeft"));
  EXPECT_GT(body.joints.at("WristRight").z(), usual.joints.at("WristRight").z() + 0.05);
  EXPECT_LT(body.joints.at("WristRight").x(), -0.2);
}

TEST(Body, OwnMeshIsMeasuredBySlices) {
  const Body body = make_body({});
  const auto file = std::filesystem::path(testing::TempDir()) / "someones_body.ply";
  write_ply(file, body.mesh);
  BodySpec spec;
  spec.mesh = file;
  const Body measured = make_body(spec);
  EXPECT_EQ(measured.mesh.triangles.size(), body.mesh.triangles.size());
  EXPECT_NEAR(measured.landmarks.stature, 1.85, 1e-6);
  EXPECT_NEAR(measured.landmarks.crotch, body.landmarks.crotch, 0.025);
  EXPECT_NEAR(measured.landmarks.armpit, body.landmarks.armpit, 0.035);
  EXPECT_NEAR(tape_girth(measured.mesh, measured.landmarks.waist), 0.81, 0.01);
  EXPECT_NEAR(tape_girth(measured.mesh, measured.landmarks.chest), 1.01, 0.02);
  EXPECT_NEAR(tape_girth(measured.mesh, measured.landmarks.hip), 0.91, 0.02);
  ASSERT_EQ(measured.joints.size(), 25u);
  for (const auto& [name, place] : measured.joints) EXPECT_LT((place - body.joints.at(name)).norm(), 0.08) << name;
}

TEST(Body, OwnMeshMustBeClosed) {
  Mesh mesh = make_body({}).mesh;
  mesh.triangles.pop_back();
  const auto file = std::filesystem::path(testing::TempDir()) / "open_body.ply";
  write_ply(file, mesh);
  BodySpec spec;
  spec.mesh = file;
  EXPECT_THROW(make_body(spec), InputError);
}

TEST(Body, OwnMeshInAnotherUnitOrPlaceIsNamedAndMended) {
  const Mesh standing = make_body({}).mesh;
  const auto file = std::filesystem::path(testing::TempDir()) / "body_elsewhere.ply";
  BodySpec spec;
  spec.mesh = file;
  const auto refused = [&](const Eigen::Matrix3d& motion, double lift_m) {
    Mesh mesh = standing;
    for (Vector3d& v : mesh.vertices) v = (motion * (v + Vector3d(0, lift_m, 0))).eval();
    write_ply(file, mesh);
    try {
      make_body(spec);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d z_up;
  z_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  EXPECT_EQ(refused(same, 0), "");
  EXPECT_THAT(refused(same, -0.2), testing::HasSubstr("body_elsewhere.ply: stands 0.200 m below the floor"));
  EXPECT_THAT(refused(same, 0.15), testing::HasSubstr("lift_m = -0.150"));
  EXPECT_THAT(refused(100 * same, 0), testing::HasSubstr("centimetres with y up"));
  EXPECT_THAT(refused(1000 * same, 0), testing::HasSubstr("millimetres with y up"));
  EXPECT_THAT(refused(10 * same, 0), testing::HasSubstr("decimetres with y up"));
  EXPECT_THAT(refused(same / 0.0254, 0), testing::HasSubstr("inches with y up"));
  EXPECT_THAT(refused(z_up, 0), testing::HasSubstr("metres with z up"));
  spec.frame = {"cm", "z", 0.2};
  EXPECT_EQ(refused(100 * z_up, -0.2), "");
  EXPECT_NEAR(make_body(spec).landmarks.stature, 1.85, 1e-6);
}

}  // namespace
}  // namespace dressform
