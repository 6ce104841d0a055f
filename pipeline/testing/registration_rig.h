#pragma once
// Four sensors about the analytic figure, for tests of registration: naked shots, a rough prior, and the true poses.
#include <map>
#include <string>
#include <utility>

#include "pipeline/registration/registration.h"
#include "pipeline/testing/test_scene.h"

namespace dressform::test_scene {

// The figure's own surface: the outermost crossing of rays towards points of its axis, as a fine closed mesh of every
// part. Parts overlap; hidden pieces lie inside and no sensor sees them.
inline Mesh figure_mesh(const Figure& figure) {
  constexpr int kRings = 48, kSides = 64;
  Mesh mesh;
  for (const auto& part : figure.parts) {
    const int first = static_cast<int>(mesh.vertices.size());
    for (int r = 0; r <= kRings; ++r)
      for (int s = 0; s < kSides; ++s) {
        const double polar = M_PI * r / kRings, turn = 2 * M_PI * s / kSides;
        const Vector3d unit(std::sin(polar) * std::sin(turn), std::cos(polar), std::sin(polar) * std::cos(turn));
        mesh.vertices.push_back(part.centre + part.rotation * unit.cwiseProduct(part.radii));
      }
    for (int r = 0; r < kRings; ++r)
      for (int s = 0; s < kSides; ++s) {
        const int a = first + r * kSides + s, b = first + r * kSides + (s + 1) % kSides, c = a + kSides, d = b + kSides;
        if (r > 0) mesh.triangles.emplace_back(a, c, b);
        if (r + 1 < kRings) mesh.triangles.emplace_back(b, c, d);
      }
  }
  return mesh;
}

struct Rig {
  CaptureSession session;
  Calibration calibration;
  BodyModel naked;
  std::map<std::string, Isometry3d> model_from_sensor, world_from_sensor;
};

// Four sensors at right angles; the model is the figure turned by `heading_deg` about the vertical.
inline Rig rendered_rig(double heading_deg, double prior_error_deg) {
  Rig rig;
  const Figure figure = standing_figure();
  const Isometry3d model_from_world(Eigen::AngleAxisd(heading_deg * M_PI / 180, Vector3d::UnitY()));
  rig.naked.body = transformed(figure_mesh(figure), model_from_world.matrix());
  rig.session.prior.emplace();
  for (int k = 0; k < 4; ++k) {
    const std::string name = "k" + std::to_string(k + 1);
    const double angle = M_PI / 2 * k + 0.05 * k;
    const Isometry3d pose =
        looking_at({2.1 * std::sin(angle), 1.25, 2.1 * std::cos(angle)}, {0.02 * k, 0.95, 0}, 0.5 * k);
    const SensorCalibration calibration = kinect(0.5, -0.01);
    rig.session.sensors.push_back(name);
    rig.calibration.sensors[name] = calibration;
    rig.session.naked[name].depth_mm =
        depth_image(figure, calibration, normalized_grid(calibration.ir), pose, 1, 40 + k);
    rig.model_from_sensor[name] = model_from_world * pose;
    rig.world_from_sensor[name] = pose;
    const auto n = normal4(9, 9, k);
    Isometry3d error(Eigen::AngleAxisd(prior_error_deg * M_PI / 180, Vector3d(n[0], n[1], n[2]).normalized()));
    error.translation() = 0.1 * Vector3d(n[1], n[2], n[3]).normalized();
    rig.session.prior->world_from_sensor[name] = pose * error;
  }
  rig.session.calibration = rig.calibration;
  return rig;
}

// With images of its own.
inline Rig copy_of(Rig rig) {
  for (auto& [sensor, shot] : rig.session.naked) shot.depth_mm = shot.depth_mm.clone();
  return rig;
}

// The same as rendered_rig: each is rendered once in a program, since every variant's tests ask for a few.
inline Rig make_rig(double heading_deg, double prior_error_deg) {
  static std::map<std::pair<double, double>, Rig> rendered;
  const std::pair key(heading_deg, prior_error_deg);
  const auto found = rendered.find(key);
  return copy_of(found != rendered.end()
                     ? found->second
                     : rendered.emplace(key, rendered_rig(heading_deg, prior_error_deg)).first->second);
}

}  // namespace dressform::test_scene
