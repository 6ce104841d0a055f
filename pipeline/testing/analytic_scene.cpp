#include "pipeline/testing/analytic_scene.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/geometry/lattice.h"
#include "scenes/random.h"

namespace dressform::analytic {
namespace {

struct Capsule {
  Vector3d a, b;
  double radius_a, radius_b;
};

double distance(const Capsule& c, const Vector3d& p) {
  const Vector3d along = c.b - c.a;
  const double t = std::clamp((p - c.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - c.a - t * along).norm() - (c.radius_a + t * (c.radius_b - c.radius_a));
}

// Torso, neck, head, and for both sides arm, hand, leg, foot. Feet stand on y = 0.
std::vector<Capsule> body_parts() {
  std::vector<Capsule> parts{{{0, 1.0, 0}, {0, 1.36, 0}, 0.135, 0.15},
                             {{0, 0.95, 0}, {0, 1.0, 0}, 0.14, 0.135},
                             {{0, 1.45, 0}, {0, 1.60, 0}, 0.06, 0.055},
                             {{0, 1.68, 0}, {0, 1.72, 0}, 0.095, 0.09}};
  for (const double side : {-1.0, 1.0}) {
    parts.push_back({{side * 0.15, 1.43, 0}, {side * 0.33, 0.95, 0}, 0.055, 0.035});   // arm
    parts.push_back({{side * 0.345, 0.91, 0}, {side * 0.37, 0.84, 0}, 0.035, 0.03});   // hand
    parts.push_back({{side * 0.085, 0.90, 0}, {side * 0.13, 0.10, 0}, 0.085, 0.045});  // leg
    parts.push_back({{side * 0.13, 0.05, 0}, {side * 0.15, 0.05, 0.12}, 0.045, 0.04});
  }
  return parts;
}

enum Material { kNothing, kSkin, kTop, kBottom, kFloor, kWall };

class World {
 public:
  explicit World(const SceneOptions& options) : options_(options), body_(body_parts()) {}

  // Signed distance and what it belongs to.
  std::pair<double, Material> nearest(const Vector3d& p, bool dressed) const {
    std::pair<double, Material> best{p.y(), kFloor};
    const auto offer = [&](double d, Material m) {
      if (d < best.first) best = {d, m};
    };
    offer(options_.wall_behind_m + p.z(), kWall);
    for (const Capsule& part : body_) offer(distance(part, p), kSkin);
    if (!dressed) return best;
    if (options_.top) offer(shirt(p), kTop);
    if (options_.dress) offer(skirt(p), kTop);
    if (options_.bottom && !options_.dress) offer(options_.skirt ? skirt(p) : trousers(p), kBottom);
    return best;
  }

 private:
  static double cut(double d, double low, double high) { return std::max({d, low, high}); }
  double shirt(const Vector3d& p) const {
    double d = 1e9;
    for (const int k : {0, 1})
      d = std::min(d, cut(distance(body_[k], p) - options_.shirt_ease_m, options_.shirt_hem_y_m - p.y(), -1));
    for (const int k : {4, 8}) {  // sleeves end at y = 1.2
      d = std::min(d, cut(distance(body_[k], p) - options_.shirt_ease_m, 1.2 - p.y(), -1));
    }
    return d;
  }
  double trousers(const Vector3d& p) const {
    double d = cut(distance(body_[1], p) - options_.bottom_ease_m, p.y() - 1.02, options_.leg_end_y_m - p.y());
    for (const int k : {6, 10})
      d = std::min(d, cut(distance(body_[k], p) - options_.bottom_ease_m, options_.leg_end_y_m - p.y(), -1));
    return d;
  }
  double skirt(const Vector3d& p) const {
    const Capsule cone{{0, 1.0, 0}, {0, 0.3, 0}, 0.145, 0.26};
    return cut(distance(cone, p), 0.45 - p.y(), p.y() - 1.02);
  }

  SceneOptions options_;
  std::vector<Capsule> body_;
};

struct Hit {
  double t = 0;  // along the ray, whose z component in the camera frame is 1
  Vector3d point = Vector3d::Zero();
  Material material = kNothing;
};

Hit trace(const World& world, const Vector3d& origin, const Vector3d& ray, bool dressed) {
  const double length = ray.norm();
  for (double t = 0.3; t < 4.5;) {
    const Vector3d p = origin + t * ray;
    const auto [d, material] = world.nearest(p, dressed);
    if (d < 2e-4) return {t, p, material};
    t += std::max(d, 2e-4) / length;
  }
  return {};
}

Vector3d normal_at(const World& world, const Vector3d& p, bool dressed) {
  Vector3d n;
  for (int k = 0; k < 3; ++k) {
    const Vector3d step = 1e-4 * Vector3d::Unit(k);
    n[k] = world.nearest(p + step, dressed).first - world.nearest(p - step, dressed).first;
  }
  return n.normalized();
}

cv::Vec3b albedo(const SceneOptions& options, const Hit& hit) {
  switch (hit.material) {
    case kSkin:
      return {175, 195, 215};
    case kTop:
      return options.top_color ? options.top_color(hit.point) : cv::Vec3b(150, 60, 30);
    case kBottom:
      return options.bottom_color ? options.bottom_color(hit.point) : cv::Vec3b(35, 32, 30);
    case kFloor:
      return {90, 110, 130};
    case kWall:
      return {190, 200, 200};
    default:
      return {0, 0, 0};
  }
}

cv::Vec3b shaded(const World& world, const SceneOptions& options, const Hit& hit, bool dressed, std::uint64_t stream,
                 std::uint64_t index) {
  if (hit.material == kNothing) return {20, 20, 20};
  const Vector3d light = (Vector3d(0.4, 2.6, 0.3) - hit.point).normalized();
  const double shade = 0.55 + 0.45 * std::max(0.0, normal_at(world, hit.point, dressed).dot(light));
  const auto noise = normal4(options.seed, stream, index);
  cv::Vec3b color = albedo(options, hit);
  for (int k = 0; k < 3; ++k) color[k] = cv::saturate_cast<uchar>(color[k] * shade + options.color_noise * noise[k]);
  return color;
}

Shot capture(const World& world, const SceneOptions& options, const SensorCalibration& sensor,
             const Isometry3d& world_from_sensor, bool dressed, std::uint64_t stream, cv::Mat* labels) {
  Shot shot;
  shot.depth_mm = cv::Mat::zeros(sensor.ir.height, sensor.ir.width, CV_16U);
  shot.ir = cv::Mat::zeros(shot.depth_mm.size(), CV_16U);
  shot.color = cv::Mat::zeros(sensor.color->height, sensor.color->width, CV_8UC3);
  cv::Mat label = cv::Mat::zeros(shot.color.size(), CV_8U);
  tbb::parallel_for(0, sensor.ir.height, [&](int y) {
    for (int x = 0; x < sensor.ir.width; ++x) {
      const Vector3d ray = world_from_sensor.linear() * sensor.ir.unproject(Vector2d(x, y), 1);
      const Hit hit = trace(world, world_from_sensor.translation(), ray, dressed);
      if (hit.material == kNothing) continue;
      const std::uint64_t index = static_cast<std::uint64_t>(y) * sensor.ir.width + x;
      const double noise = options.noise_mm * normal(options.seed, stream, index);
      shot.depth_mm.at<ushort>(y, x) = cv::saturate_cast<ushort>(1000 * hit.t + noise);
    }
  });
  const Isometry3d world_from_color = world_from_sensor * sensor.color_from_ir.inverse();
  tbb::parallel_for(0, sensor.color->height, [&](int y) {
    for (int x = 0; x < sensor.color->width; ++x) {
      const Vector3d ray = world_from_color.linear() * sensor.color->unproject(Vector2d(x, y), 1);
      const Hit hit = trace(world, world_from_color.translation(), ray, dressed);
      const std::uint64_t index = static_cast<std::uint64_t>(y) * sensor.color->width + x;
      shot.color.at<cv::Vec3b>(y, x) = shaded(world, options, hit, dressed, stream + 1, index);
      const bool worn = hit.material == kSkin || hit.material == kTop || hit.material == kBottom;
      label.at<uchar>(y, x) = worn ? static_cast<uchar>(hit.material) : uchar{0};
    }
  });
  if (labels) *labels = label;
  return shot;
}

// The zero level of the body's distance.
Mesh body_mesh(const std::vector<Capsule>& parts, double step_m) {
  const Lattice lattice = make_lattice({-0.45, -0.05, -0.25}, {0.45, 1.85, 0.25}, 0, step_m);
  std::vector<float> field(lattice.count());
  tbb::parallel_for(std::size_t{0}, field.size(), [&](std::size_t i) {
    double d = 1e9;
    for (const Capsule& part : parts) d = std::min(d, distance(part, lattice.point(i)));
    field[i] = static_cast<float>(d);
  });
  return lattice_surface(lattice, field);
}

SensorCalibration scaled_kinect(double scale) {
  SensorCalibration sensor;
  sensor.model = "kinect_v2";
  sensor.color = Camera{1920, 1080, 1070, 1068, 955, 530, {0.05, -0.07, 0.0005, -0.0005, 0.02}}.scaled(scale);
  sensor.ir = Camera{512, 424, 367, 366, 255, 206, {0.09, -0.27, 0, 0, 0.1}}.scaled(scale);
  sensor.color_from_ir.translation() = Vector3d(-0.052, 0.0005, 0.001);
  return sensor;
}

Isometry3d world_from_sensor_at(double heading_rad) {
  Isometry3d pose = Isometry3d::Identity();
  const Vector3d outward(std::sin(heading_rad), 0, std::cos(heading_rad));
  pose.linear().col(2) = -outward;
  pose.linear().col(1) = Vector3d(0, -1, 0);
  pose.linear().col(0) = pose.linear().col(1).cross(pose.linear().col(2));
  pose.translation() = 2.1 * outward + Vector3d(0, 1.25, 0);
  return pose;
}

}  // namespace

AnalyticScene make_scene(const SceneOptions& options) {
  AnalyticScene scene;
  const World world(options);
  scene.session.name = "analytic";
  scene.session.prior.emplace();
  SceneOptions no_wall = options;
  no_wall.wall_behind_m = 10;
  const World open_world(no_wall);
  const std::array<const char*, 4> names{"k1", "k2", "k3", "k4"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string name = names[k];
    const auto sensor = scaled_kinect(options.scale);
    const Isometry3d pose = world_from_sensor_at(M_PI / 2 * static_cast<double>(k));
    // The wall would stand between the mannequin and the sensor at the back.
    const World& seen = k == 2 ? open_world : world;
    scene.calibration.sensors[name] = sensor;
    scene.session.sensors.push_back(name);
    scene.session.naked[name] = capture(seen, options, sensor, pose, false, 10 * k, nullptr);
    scene.session.dressed[name] = capture(seen, options, sensor, pose, true, 10 * k + 5, &scene.labels[name]);
    const auto error = normal4(options.seed, stream_of("prior"), k);
    Isometry3d prior = pose;
    prior.rotate(Eigen::AngleAxisd(0.07 * error[0], Vector3d::UnitY()));
    prior.translation() += 0.06 * Vector3d(error[1], error[2], error[3]);
    scene.session.prior->world_from_sensor[name] = prior;
    scene.registration.model_from_sensor[name] = pose;
    scene.registration.converged[name] = true;
  }
  scene.session.calibration = scene.calibration;
  scene.naked.body = body_mesh(body_parts(), 0.01);
  scene.naked.converged = true;
  scene.body = known_body(scene.naked.body);
  return scene;
}

double label_iou(const cv::Mat& found, const cv::Mat& truth, int label) {
  const int both = cv::countNonZero((found == label) & (truth == label));
  const int any = cv::countNonZero((found == label) | (truth == label));
  return any ? both / static_cast<double>(any) : 1;
}

TEST(AnalyticScene, IsWhatItSays) {
  const auto scene = make_scene();
  EXPECT_EQ(scene.session.sensors.size(), 4u);
  for (const auto& [name, labels] : scene.labels)
    for (const int label : {1, 2, 3}) EXPECT_GT(cv::countNonZero(labels == label), 500) << name << label;
  const Topology body = topology(scene.naked.body);
  EXPECT_TRUE(body.closed());
  EXPECT_EQ(body.euler(), 2);
  EXPECT_EQ(body.components, 1);
  const Shot& shot = scene.session.naked.at("k1");
  EXPECT_NEAR(shot.depth_mm.at<ushort>(52, 64), 1950, 40);  // the chest, a torso's radius before the axis
}

}  // namespace dressform::analytic
