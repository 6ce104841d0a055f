#include <cmath>

#include "eval/studies/draw/draw_parts.h"

namespace dressform {
namespace {

constexpr double kDegrees = 180 / M_PI;

// A usual unit of a device, and from how far it sees a whole person.
struct UsualUnit {
  Camera ir, color;
  Vector3d color_from_ir_m;
  double nearest_m, farthest_m, height_m, scan_radius_m;
};

Camera camera(int width, int height, double focal_px, std::array<double, 5> distortion) {
  Camera result;
  result.width = width;
  result.height = height;
  result.fx = result.fy = focal_px;
  result.cx = 0.5 * (width - 1);
  result.cy = 0.5 * (height - 1);
  for (int i = 0; i < 5; ++i) result.distortion[i] = distortion[i];
  return result;
}

// The means of the units of scenes/library/rigs.
UsualUnit usual_unit(const std::string& device) {
  if (device == "kinect_v1")
    return {camera(640, 480, 579.8, {-0.0653, 0.1357, -0.0008, 0.0002, 0}),
            camera(640, 480, 525.0, {0.2402, -0.6861, -0.0015, 0.0003, 0.7859}),
            {-0.0254, -0.0001, -0.0023},
            2.45,
            2.7,
            0.95,
            2.2};
  return {camera(512, 424, 373.8, {0.1018, -0.2966, -0.0005, -0.0006, 0.1119}),
          camera(1920, 1080, 1082.5, {0.0577, -0.0683, 0, -0.0014, 0.0159}),
          {0.0511, 0.0001, -0.0008},
          1.95,
          2.4,
          1.25,
          1.87};
}

// Units differ by a percent in focal length and a few pixels in the principal point.
Camera draw_unit(const Camera& usual, const Dice& dice) {
  Camera result = usual;
  result.fx = dice.normal_about("fx", usual.fx, 0.01 * usual.fx, 2);
  result.fy = Dice::rounded(result.fx * dice.between("aspect", 0.995, 0.999, 4), 2);
  const double shift_px = 0.01 * usual.width;
  result.cx = dice.normal_about("cx", usual.cx, shift_px, 2);
  result.cy = dice.normal_about("cy", usual.cy, shift_px, 2);
  return result;
}

// From where soles and crown are in the infrared image, some pixels within its borders however the unit is tilted.
double whole_person_from_m(const UsualUnit& unit, double stature_m) {
  constexpr double kSlack = 0.06;  // of the focal length: principal points and pitch that differ
  return Dice::rounded(0.5 * stature_m / (0.5 * unit.ir.height / unit.ir.fy - kSlack), 3);
}

// Halfway between the soles and the top of the head, as the sensor sees them.
double level_pitch_deg(const SensorPlace& place, double stature_m) {
  const double feet = std::atan2(-place.height_m, place.distance_m);
  const double head = std::atan2(stature_m - place.height_m, place.distance_m);
  return 0.5 * (feet + head) * kDegrees;
}

SensorPlace draw_sensor_place(const UsualUnit& unit, double azimuth_deg, double stature_m, const Dice& dice) {
  SensorPlace place;
  place.azimuth_deg = Dice::rounded(std::remainder(azimuth_deg + dice.normal_about("azimuth", 0, 3), 360), 2);
  const double nearest_m = std::max(unit.nearest_m, whole_person_from_m(unit, stature_m));
  place.distance_m = dice.between("distance", nearest_m, nearest_m + unit.farthest_m - unit.nearest_m);
  // Lower before someone small.
  place.height_m = Dice::rounded(std::min(unit.height_m, 0.75 * stature_m) + dice.between("height", -0.1, 0.1), 3);
  place.yaw_deg = dice.normal_about("yaw", 0, 1, 2);
  place.pitch_deg = Dice::rounded(level_pitch_deg(place, stature_m) + dice.between("pitch", -1, 1), 2);
  place.roll_deg = dice.normal_about("roll", 0, 1, 2);
  return place;
}

DrawnSensor draw_sensor(const std::string& device, double azimuth_deg, double stature_m, const Dice& dice) {
  const UsualUnit unit = usual_unit(device);
  DrawnSensor sensor;
  sensor.place = draw_sensor_place(unit, azimuth_deg, stature_m, dice);
  SensorSpec& spec = sensor.spec;
  spec.calibration.model = device;
  spec.calibration.ir = draw_unit(unit.ir, dice.part("ir"));
  spec.calibration.color = draw_unit(unit.color, dice.part("color"));
  for (int axis = 0; axis < 3; ++axis)
    spec.calibration.color_from_ir.translation()[axis] =
        dice.normal_about("step " + std::to_string(axis), unit.color_from_ir_m[axis], 0.0005, 5);
  const double side_deg = std::abs(std::remainder(sensor.place.azimuth_deg, 180));
  spec.body_tracking = side_deg < 30;  // the SDK tracks front and back views only
  spec.exposure = dice.between("exposure", 0.85, 1.15, 2);
  spec.gain = dice.between("gain", 1, 2, 2);
  spec.white_balance = {dice.between("red", 0.95, 1.06, 2), 1, dice.between("blue", 0.94, 1.06, 2)};
  return sensor;
}

std::string device_of(const std::string& sensor_model) {
  return sensor_model == "kinect_v1" ? "kinect_v1" : "kinect_v2";
}

}  // namespace

std::vector<DrawnSensor> draw_rig(const DrawnWishes& wishes, const BodySpec& wearer, const Dice& dice) {
  const std::string drawn = dice.weighted("count", {{"3", 0.2}, {"4", 0.45}, {"5", 0.1}, {"6", 0.15}, {"8", 0.1}});
  const int count = wishes.sensors > 0 ? wishes.sensors : std::stoi(drawn);
  std::vector<DrawnSensor> rig;
  for (int i = 0; i < count; ++i) {
    const std::string name = "k" + std::to_string(i + 1);
    // In front first, then round by its right side.
    rig.push_back(draw_sensor(device_of(wishes.sensor_model), -360.0 * i / count, wearer.stature_m, dice.part(name)));
    rig.back().spec.name = name;
  }
  return rig;
}

ScanSpec draw_scan(const DrawnWishes& wishes, const Dice& dice) {
  const std::string device = device_of(wishes.sensor_model);
  const UsualUnit unit = usual_unit(device);
  ScanSpec scan;
  scan.calibration.model = device;
  scan.calibration.ir = draw_unit(unit.ir, dice);
  scan.radius_m = Dice::rounded(unit.scan_radius_m + dice.between("radius", -0.1, 0.1), 3);
  scan.height_m = Dice::rounded(unit.height_m - 0.1 + dice.between("height", -0.1, 0.1), 3);
  return scan;
}

RoomSpec draw_room(const DrawnWishes& wishes, const std::vector<DrawnSensor>& rig, const ScanSpec& scan,
                   const Dice& dice) {
  constexpr double kBehindSensor_m = 0.3, kSway_m = 0.2;
  double reach_m = scan.radius_m + kSway_m;
  for (const auto& sensor : rig) reach_m = std::max(reach_m, sensor.place.distance_m + kBehindSensor_m);
  const bool large = wishes.rooms == "large" || (wishes.rooms == "any" && dice.chance("large", 0.5));
  RoomSpec room;
  room.width_m =
      Dice::rounded(2 * reach_m + (large ? dice.between("width", 1.0, 4.0) : dice.between("width", 0, 1)), 2);
  room.depth_m =
      Dice::rounded(2 * reach_m + (large ? dice.between("depth", 1.0, 4.0) : dice.between("depth", 0, 1)), 2);
  room.height_m = dice.between("height", 2.4, 3.2, 2);
  room.furniture = dice.chance("furniture", 0.75);
  return room;
}

// Bulbs below the ceiling, opposite one another as far as two or three can be.
std::vector<LightSpec> draw_lights(const RoomSpec& room, const Dice& dice) {
  const int count = dice.whole("count", 2, 3);
  const double first_deg = dice.between("first", 0, 360, 1);
  std::vector<LightSpec> lights;
  for (int i = 0; i < count; ++i) {
    const Dice bulb = dice.part(std::to_string(i));
    const double angle = (first_deg + 360.0 * i / count + bulb.normal_about("angle", 0, 12)) / kDegrees;
    LightSpec light;
    light.position_m = {Dice::rounded(0.36 * room.width_m * std::sin(angle), 3),
                        Dice::rounded(room.height_m - bulb.between("below", 0.2, 0.5), 3),
                        Dice::rounded(0.40 * room.depth_m * std::cos(angle), 3)};
    light.radius_m = bulb.between("radius", 0.03, 0.12);
    const double strength = bulb.between("strength", 0.8, 1.4) * 2 / count, warmth = bulb.between("warmth", 0, 0.2);
    light.intensity_rgb = {Dice::rounded(strength, 3), Dice::rounded(strength * (1 - 0.4 * warmth), 3),
                           Dice::rounded(strength * (1 - warmth), 3)};
    lights.push_back(light);
  }
  return lights;
}

}  // namespace dressform
