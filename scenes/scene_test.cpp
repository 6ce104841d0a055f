#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <fstream>

#include "scenes/scene_parts.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kLibrary = fs::path(DRESSFORM_SOURCE_DIR) / "scenes/library";

// A folder with one scene file, "scene.toml", that stands on the library's rig and scan.
class SceneFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("scene_" + std::string(test_name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  static const char* test_name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  static std::string base() {
    return "rig = \"" + (kLibrary / "rigs/thesis.toml").string() + "\"\nscan = \"" +
           (kLibrary / "scans/handheld.toml").string() + "\"\n";
  }
  Scene read(const std::string& text) {
    write("scene.toml", text);
    return read_scene(folder_ / "scene.toml");
  }
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  fs::path folder_;
};

const char* kShirt = "[[garment]]\nkind = \"shirt\"\n";

TEST(SceneLibrary, EverySceneParses) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(kLibrary)) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path());
    const Scene scene = read_scene(entry.path());
    EXPECT_EQ(scene.name, entry.path().stem());
    EXPECT_EQ(scene.garments.size(), 2u);
    EXPECT_EQ(scene.rig.size(), 4u);
    EXPECT_EQ(scene.lights.size(), 2u);
    EXPECT_DOUBLE_EQ(scene.body.chest_m, 1.01);
    EXPECT_GT(scene.user.waist_m, scene.body.waist_m + 0.1);
    const bool older = scene.rig[0].calibration.model == "kinect_v1";
    EXPECT_EQ(scene.sensor_model.variant, older ? "kinect_v1" : "kinect_v2");
    ++scenes;
  }
  EXPECT_EQ(scenes, 5);  // the four groups, and the first one before four Kinects v1
}

TEST(SceneLibrary, RigStandsRoundTheMannequin) {
  const Scene scene = read_scene(kLibrary / "group1.toml");
  const std::vector<Vector3d> towards = {{0, 0, 1}, {-1, 0, 0}, {0, 0, -1}, {1, 0, 0}};
  for (int i = 0; i < 4; ++i) {
    const auto& sensor = scene.rig[i];
    const Isometry3d& pose = sensor.world_from_sensor;
    EXPECT_EQ(sensor.name, "k" + std::to_string(i + 1));
    EXPECT_NEAR((pose.linear() * pose.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(pose.linear().determinant(), 1, 1e-12);
    Vector3d level = pose.translation();
    level.y() = 0;
    EXPECT_NEAR(level.norm(), 2.1, 0.13);
    EXPECT_GT(level.normalized().dot(towards[i]), std::cos(5 * M_PI / 180));
    EXPECT_NEAR(pose.translation().y(), 1.25, 0.06);
    EXPECT_GT(pose.linear().col(2).dot(-towards[i]), std::cos(8 * M_PI / 180)) << "looks at the mannequin";
    EXPECT_LT(pose.linear().col(1).y(), -0.99) << "the image's down is the world's down";
    EXPECT_EQ(sensor.body_tracking, i % 2 == 0);
    const Isometry3d step = sensor.calibration.color_from_ir;
    EXPECT_NEAR((step.linear() * step.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(step.translation().x(), 0.051, 0.001);
  }
}

TEST_F(SceneFile, DeviationsTurnTheSensorAsDescribed) {
  const auto sensor = [](const std::string& turn) {
    return "scan = \"" + (kLibrary / "scans/handheld.toml").string() + "\"\n" + kShirt +
           "[[rig.sensor]]\nname = \"k1\"\n" + turn +
           "\nir = {width = 512, height = 424, fx = 365, fy = 365, cx = 256, cy = 212}\n";
  };
  const auto pose = [&](const std::string& turn) { return read(sensor(turn)).rig[0].world_from_sensor; };
  EXPECT_NEAR((pose("distance_m = 2.0").translation() - Vector3d(0, 1.25, 2.0)).norm(), 0, 1e-12);
  EXPECT_NEAR((pose("").linear().col(2) - Vector3d(0, 0, -1)).norm(), 0, 1e-12);
  EXPECT_NEAR((pose("").linear().col(0) - Vector3d(1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(pose("azimuth_deg = 90").translation().x(), 2.1, 1e-12);
  EXPECT_NEAR(pose("pitch_deg = 30").linear().col(2).y(), 0.5, 1e-12);
  EXPECT_NEAR(pose("yaw_deg = 30").linear().col(2).x(), -0.5, 1e-12);
  EXPECT_NEAR(pose("roll_deg = 30").linear().col(0).y(), -0.5, 1e-12);
}

TEST_F(SceneFile, PlacedByMatrix) {
  const Scene scene =
      read("scan = \"" + (kLibrary / "scans/handheld.toml").string() + "\"\n" + kShirt +
           "[[rig.sensor]]\nname = \"a\"\nir = {width = 5, height = 4, fx = 3, fy = 3, cx = 2, cy = 2}\n"
           "[rig.sensor.world_from_sensor]\nrotation = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]\n"
           "translation_m = [1, 2, 3]\n");
  EXPECT_EQ(scene.rig[0].world_from_sensor.translation(), Vector3d(1, 2, 3));
  EXPECT_NEAR(scene.rig[0].world_from_sensor.linear()(1, 2), -1, 1e-12);
}

TEST_F(SceneFile, OwnMeshes) {
  for (const char* name : {"x.obj", "y.obj", "y.png"}) write(name, "");
  const Scene scene = read(base() +
                           "[body]\nmesh = \"x.obj\"\n[[garment]]\nkind = \"skirt\"\nmesh = \"y.obj\"\n"
                           "texture = \"y.png\"\n[[garment]]\nkind = \"dress\"\nmesh = \"y.obj\"\n");
  EXPECT_EQ(scene.body.mesh, folder_ / "x.obj");
  EXPECT_EQ(scene.user.mesh, folder_ / "x.obj") << "without [user], the customer is the mannequin";
  EXPECT_EQ(scene.garments[0].mesh, folder_ / "y.obj");
  EXPECT_EQ(scene.garments[0].texture, folder_ / "y.png");
  EXPECT_EQ(scene.garments[0].slot, "bottom");
  EXPECT_EQ(scene.garments[1].slot, "top");
}

TEST_F(SceneFile, OwnMeshesMayBeInOtherUnits) {
  for (const char* name : {"x.obj", "y.obj"}) write(name, "");
  const Scene scene = read(base() +
                           "[body]\nmesh = \"x.obj\"\nunit = \"dm\"\nlift_m = 0.9\n[[garment]]\nkind = \"skirt\"\n"
                           "mesh = \"y.obj\"\nunit = \"cm\"\nup = \"z\"\n");
  EXPECT_EQ(scene.body.frame.unit, "dm");
  EXPECT_EQ(scene.body.frame.lift_m, 0.9);
  EXPECT_EQ(scene.user.frame.unit, "dm");
  EXPECT_EQ(scene.garments[0].frame.unit, "cm");
  EXPECT_EQ(scene.garments[0].frame.up, "z");
  EXPECT_THAT(error_of(base() + kShirt + "mesh = \"y.obj\"\nunit = \"yard\"\n"), HasSubstr("inch"));
  EXPECT_THAT(error_of(base() + kShirt + "unit = \"cm\"\n"), HasSubstr("without a mesh"));
}

TEST_F(SceneFile, NumbersInAnotherUnitAreNamed) {
  EXPECT_THAT(error_of(base() + kShirt + "[user]\nstature_m = 173.0\n"), HasSubstr("looks like centimetres"));
  EXPECT_THAT(error_of(base() + kShirt + "[user]\nchest_m = 980.0\n"), HasSubstr("looks like millimetres"));
}

TEST_F(SceneFile, CustomersAreSampledInsteadOfGiven) {
  const Scene scene = read(base() + kShirt + "[user]\nsample = \"woman\"\nsample_seed = 7\npose = \"a_pose\"\n");
  EXPECT_EQ(scene.user.sample, "woman");
  EXPECT_EQ(scene.user.sample_seed, 7);
  EXPECT_EQ(scene.user.pose, "a_pose");
  EXPECT_THAT(error_of(base() + kShirt + "[user]\nsample = \"woman\"\nhip_m = 1.0\n"), HasSubstr("beside sample"));
  EXPECT_THAT(error_of(base() + kShirt + "[user]\nsample = \"child\"\n"), HasSubstr("woman"));
}

TEST_F(SceneFile, KeysOverrideTheFileTheyStandOn) {
  const auto shirt = (kLibrary / "garments/shirt1.toml").string();
  const Scene scene = read(base() + "[[garment]]\nfile = \"" + shirt + "\"\nease_m = 0.2\n");
  EXPECT_EQ(scene.garments[0].ease_m, 0.2);
  EXPECT_EQ(scene.garments[0].name, "shirt 1");
  EXPECT_EQ(scene.garments[0].print.kind, "stars");
  EXPECT_THAT(scene.toml, HasSubstr("# sleeve = ")) << "the text carries the files it was made of";
}

TEST_F(SceneFile, SensorModelWithParameters) {
  const Scene scene = read(base() + kShirt + "[sensor]\nmodel = \"ideal\"\n[sensor.ideal]\nquantise = true\nn = 3\n");
  EXPECT_EQ(scene.sensor_model.variant, "ideal");
  EXPECT_EQ(std::get<bool>(scene.sensor_model.values.at("quantise")), true);
  EXPECT_EQ(std::get<int>(scene.sensor_model.values.at("n")), 3);
}

TEST_F(SceneFile, ErrorsCarryFileLineAndColumn) {
  const auto at = [&](const std::string& position) { return (folder_ / "scene.toml").string() + position; };
  EXPECT_THAT(error_of("name = \n"), HasSubstr(at(":1:")));
  EXPECT_THAT(error_of("name = \"a\"\n[body\n"), HasSubstr(at(":2:")));
  EXPECT_THAT(error_of(base() + "[body]\nchest = 1.0\n"), HasSubstr(at(":4:1: unknown key \"chest\" in body")));
  EXPECT_THAT(error_of(base() + "[body]\nchest = 1.0\n"),
              HasSubstr("known are mesh, unit, up, lift_m, sex, stature_m"));
  EXPECT_THAT(error_of(base() + kShirt + "[sensors]\n"), HasSubstr("unknown key \"sensors\""));
  EXPECT_THAT(error_of(base() + "[body]\nchest_m = 9\n"), HasSubstr(at(":4:11: body.chest_m: found 9; expected 0.5")));
  EXPECT_THAT(error_of(base() + "[body]\nchest_m = nan\n"), HasSubstr(at(":4:11: body.chest_m: found nan")));
  EXPECT_THAT(error_of(base() + "[body]\nchest_m = \"x\"\n"), HasSubstr("found string; expected a number"));
  EXPECT_THAT(error_of(base() + "[body]\nsex = \"both\"\n"), HasSubstr("expected one of male, female"));
  EXPECT_THAT(error_of(base() + "[[garment]]\nkind = \"hat\"\n"), HasSubstr("shirt, trousers, skirt, dress"));
  EXPECT_THAT(error_of(base() + "body = \"none.toml\"\n"), HasSubstr(at(":3:8: found \"none.toml\"; expected a file")));
  EXPECT_THAT(error_of(base() + kShirt + "mesh = \"none.obj\"\n"), HasSubstr(at(":5:8")));
  EXPECT_THAT(error_of(base() + kShirt + kShirt), HasSubstr("second top garment"));
  EXPECT_THAT(error_of(base()), HasSubstr("no [[garment]]"));
  EXPECT_THAT(error_of(kShirt), HasSubstr("no rig"));
  EXPECT_THAT(error_of(base() + kShirt + "[garment.print]\ncolors = [\"blue\"]\n"), HasSubstr("#rrggbb"));
}

TEST_F(SceneFile, ErrorsInAReferencedFileNameThatFile) {
  write("body.toml", "\n  waist_m = 0.1\n");
  EXPECT_THAT(error_of(base() + kShirt + "[user]\nfile = \"body.toml\"\n"),
              HasSubstr((folder_ / "body.toml").string() + ":2:13: user.waist_m: found 0.1"));
  write("body.toml", "file = \"body.toml\"\n");
  EXPECT_THAT(error_of(base() + kShirt + "[user]\nfile = \"body.toml\"\n"), HasSubstr("8 files"));
}

TEST_F(SceneFile, MatrixThatIsNoRotation) {
  const auto text = [&](const char* matrix) {
    return "scan = \"" + (kLibrary / "scans/handheld.toml").string() + "\"\n" + kShirt +
           "[[rig.sensor]]\nname = \"a\"\nir = {width = 5, height = 4, fx = 3, fy = 3, cx = 2, cy = 2}\n"
           "color_from_ir = {rotation = " +
           matrix + "}\n";
  };
  EXPECT_THAT(error_of(text("[[1, 0, 0], [0, 1, 0], [0, 0, -1]]")), HasSubstr("is no rotation"));
  EXPECT_THAT(error_of(text("[[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]")), HasSubstr("is no rotation"));
  EXPECT_THAT(error_of(text("[[1, 0], [0, 1], [0, 0]]")), HasSubstr("found 2 elements; expected 3"));
  EXPECT_EQ(error_of(text("[[1, 0.0004, 0], [-0.0004, 1, 0], [0, 0, 1]]")), "no error");
}

// A stored capture is known by the text: a file that it left out would give a stale one.
TEST_F(SceneFile, ARigOfSeveralFilesStandsInTheTextWhole) {
  const Scene scene = read(base() + "[[garment]]\nkind = \"shirt\"\n");
  const auto text_with = [&](const std::string& distance) {
    write("inner.toml", "file = \"" + (kLibrary / "rigs/thesis.toml").string() + "\"\n# at " + distance + "\n");
    write("outer.toml", "file = \"inner.toml\"\n");
    const Scene changed = with_rig(scene, folder_ / "outer.toml");
    EXPECT_EQ(changed.rig.size(), scene.rig.size());
    return changed.toml;
  };
  const std::string near = text_with("2 m"), far = text_with("3 m");
  EXPECT_NE(near, far);
  EXPECT_THAT(near, HasSubstr("# --- instead of its rig\n"));
  EXPECT_THAT(near, HasSubstr("# --- inner.toml\n"));
  EXPECT_EQ(with_rig(scene, folder_ / "outer.toml").toml, far);
}

TEST_F(SceneFile, SensorsAreNotNamedLikeFramesOfPicks) {
  write("rig.toml", "[[sensor]]\nname = \"user\"\n");
  const std::string scan = "scan = \"" + (kLibrary / "scans/handheld.toml").string() + "\"\n";
  EXPECT_THAT(error_of("rig = \"rig.toml\"\n" + scan + "[[garment]]\nkind = \"shirt\"\n"),
              HasSubstr("rig.toml:2:8: sensor.name: found \"user\", which names a frame of picks"));
}

TEST(Scaled, ShrinksEveryCamera) {
  const Scene scene = read_scene(kLibrary / "group2.toml");
  const Scene half = scaled(scene, 0.5);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(half.rig[i].calibration.ir.width, 256);
    EXPECT_EQ(half.rig[i].calibration.color->height, 540);
    EXPECT_NEAR(half.rig[i].calibration.color->fx, scene.rig[i].calibration.color->fx / 2, 1e-9);
  }
  EXPECT_EQ(half.scan.calibration.ir.height, 212);
  EXPECT_THROW(scaled(scene, 0), InputError);
  EXPECT_THROW(scaled(scene, 1.5), InputError);
}

}  // namespace
}  // namespace dressform
