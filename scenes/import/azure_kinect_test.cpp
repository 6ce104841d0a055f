#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scenes/import/import_fixture.h"
#include "scenes/import/rational_lens.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

const cv::Size kDepth(640, 576), kColor(1280, 720);

json camera(const std::string& location, const std::vector<double>& parameters, double step_m) {
  return {{"Location", "CALIBRATION_CameraLocation" + location},
          {"Intrinsics",
           {{"ModelType", "CALIBRATION_LensDistortionModelBrownConrady"},
            {"ModelParameterCount", 14},
            {"ModelParameters", parameters}}},
          {"MetricRadius", 1.7},
          {"Rt", {{"Rotation", {1, 0, 0, 0, 1, 0, 0, 0, 1}}, {"Translation", {step_m, 0, 0}}}}};
}

// A device's numbers, as devices have them: the depth camera's lens is a quotient of two large polynomials.
json device() {
  return {{"CalibrationInformation",
           {{"Cameras",
             {camera("D0",
                     {0.5122698, 0.4945123, 0.4921168, 0.4921668, 3.130577, 2.324939, 0.130416, 3.458652, 3.350115,
                      0.662942, 0, 0, -5e-5, 8e-5},
                     0),
              camera("PV0", {0.4967627, 0.5108628, 0.4709071, 0.6274454, 0.05, -0.06, 0.01, 0, 0, 0, 0, 0, 0, 0},
                     -0.032)}}}}};
}

class ImportAzureKinect : public Import {
 protected:
  void SetUp() override {
    Import::SetUp();
    write("calibration.json", device().dump());
    for (int i = 0; i < 3; ++i) {
      const std::string name = "0000" + std::to_string(i) + ".png";
      image("depth/" + name, ramp(kDepth, 1500 + i, 0));
      image("ir/" + name, ramp(kDepth, 300 + i, 0));
      image("color/" + name, cv::Mat(kColor, CV_8UC3, cv::Scalar(10 + i, 20, 30)));
    }
  }
  std::string error_after(const std::function<void(json&)>& change) {
    json file = device();
    change(file["CalibrationInformation"]);
    write("calibration.json", file.dump());
    const std::string text = error(of("azure_kinect", "naked"));
    write("calibration.json", device().dump());
    return text;
  }
};

TEST_F(ImportAzureKinect, AShotWithItsCameras) {
  ImportRequest request = of("azure_kinect", "dressed");
  request.first = 1;
  const CaptureSession session = imported(request);
  const Shot& shot = session.dressed.at("k1");
  EXPECT_EQ(shot.depth_mm.at<std::uint16_t>(5, 5), 1501);
  EXPECT_EQ(shot.ir.at<std::uint16_t>(5, 5), 301);
  EXPECT_EQ(shot.color.at<cv::Vec3b>(5, 5), cv::Vec3b(11, 20, 30));
  const SensorCalibration& sensor = session.calibration->sensors.at("k1");
  EXPECT_EQ(sensor.model, "azure_kinect");
  EXPECT_NEAR(sensor.ir.fx, 503.93, 3);  // the polynomial lens takes up part of it
  EXPECT_NEAR(sensor.ir.cx, 332.064, 1e-3);
  EXPECT_NEAR(sensor.ir.cy, 325.881, 1e-3);
  EXPECT_NEAR(sensor.color->fx, 0.4709071 * 1280, 1e-3);
  EXPECT_NEAR(sensor.color->fy, 0.6274454 * 960, 1e-3);
  EXPECT_NEAR(sensor.color->cy, 0.5108628 * 960 - 120 - 0.5, 1e-3);
  EXPECT_NEAR(sensor.color->distortion[1], -0.06, 1e-6);
  EXPECT_NEAR(sensor.color_from_ir.translation().x(), -0.032, 1e-12);
}

// Directions through the fitted lens land where the device's own model puts them.
TEST_F(ImportAzureKinect, TheLensIsTheDevices) {
  const RationalLens lens{{3.130577, 2.324939, 0.130416, 3.458652, 3.350115, 0.662942}, 8e-5, -5e-5};
  const Camera plain{640, 576, 503.93, 503.98, 332.06, 325.88, {}};
  const PolynomialFit fit = with_polynomial_lens(plain, lens, 1.7);
  EXPECT_LT(fit.rms_px, 0.2);
  EXPECT_LT(fit.worst_px, 0.5);
  for (const Vector2d& at : {Vector2d(0, 0), Vector2d(0.3, 0.2), Vector2d(-0.6, 0.1), Vector2d(0.5, -0.6)}) {
    const double s = at.squaredNorm(), k = (1 + s * (lens.radial[0] + s * (lens.radial[1] + s * lens.radial[2]))) /
                                           (1 + s * (lens.radial[3] + s * (lens.radial[4] + s * lens.radial[5])));
    const Vector2d tangential(2 * lens.p1 * at.x() * at.y() + lens.p2 * (s + 2 * at.x() * at.x()),
                              lens.p1 * (s + 2 * at.y() * at.y()) + 2 * lens.p2 * at.x() * at.y());
    const Vector2d wanted =
        (k * at + tangential).cwiseProduct(Vector2d(plain.fx, plain.fy)) + Vector2d(plain.cx, plain.cy);
    EXPECT_LT((fit.camera.project(Vector3d(at.x(), at.y(), 1)) - wanted).norm(), 0.5) << at.transpose();
  }
}

TEST_F(ImportAzureKinect, ScansNeedDepthAlone) {
  fs::remove_all(recording_ / "color");
  fs::remove_all(recording_ / "ir");
  const CaptureSession session = imported(of("azure_kinect"));
  EXPECT_EQ(session.scans.at("scan_user").depth_mm.size(), 3u);
  EXPECT_FALSE(session.calibration->sensors.at("handheld").color);
  EXPECT_THAT(report_.notes, Contains(HasSubstr("lens of depth: six radial coefficients became three")));
  fs::remove_all(session_);
  EXPECT_THAT(error(of("azure_kinect", "naked")), HasSubstr("color: is missing"));
}

TEST_F(ImportAzureKinect, Errors) {
  EXPECT_THAT(error_after([](json& f) { f["Cameras"][0]["Intrinsics"]["ModelParameters"][3] = -0.49; }),
              HasSubstr("Cameras[0].Intrinsics.ModelParameters: fy: found -501.76 px"));
  EXPECT_THAT(error_after([](json& f) { f["Cameras"][1]["Intrinsics"]["ModelType"] = "Rational6KT"; }),
              HasSubstr("Cameras[1].Intrinsics.ModelType: found \"Rational6KT\""));
  EXPECT_THAT(error_after([](json& f) { f["Cameras"][1]["Rt"]["Translation"][0] = -32; }),
              HasSubstr("color_from_ir: found a step of 32 m"));
  EXPECT_THAT(error_after([](json& f) { f["Cameras"][1]["Rt"]["Rotation"][0] = 0.5; }),
              HasSubstr("Rt.Rotation: found a matrix that is no rotation"));
  EXPECT_THAT(error_after([](json& f) { f["Cameras"].erase(0); }), HasSubstr("CALIBRATION_CameraLocationD0"));
  image("depth/00000.png", ramp({320, 240}, 1500, 0));
  EXPECT_THAT(error(of("azure_kinect")), HasSubstr("00000.png: found 320 x 240 pixels; expected one of the camera's"));
  fs::remove(recording_ / "calibration.json");
  EXPECT_THAT(error(of("azure_kinect")), HasSubstr("calibration.json: is missing"));
}

}  // namespace
}  // namespace dressform
