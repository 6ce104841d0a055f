// What the stages of cameras, views and bodies would have given.
#include <tbb/parallel_for.h>

#include <opencv2/core.hpp>

#include "eval/oracle/oracle_frames.h"
#include "pipeline/geometry/mesh_query.h"
#include "scenes/error.h"
#include "scenes/label.h"

namespace dressform {
namespace {

void give_calibration(const OracleInput& input, GivenArtifacts& given) {
  const auto& known = input.truth.calibration ? input.truth.calibration : input.session.calibration;
  if (!known) throw InputError("truth", "has no calibration; expected the true cameras");
  Calibrated result;
  result.calibration = *known;
  given.give<Calibrate>("calibrate", result);
}

// The true body where it stood, in a frame that is the world's but for a shift which brings the body's axis to x = z =
// 0; what else the scan saw goes along.
BodyModel true_body(const BodyModel& scanned, const Mesh& body, const std::vector<Isometry3d>& world_from_frame) {
  if (body.triangles.empty() || world_from_frame.empty())
    throw InputError("truth", "has no body or no poses of its scan; expected both");
  Isometry3d model_from_world = Isometry3d::Identity();
  const Vector3d centre = centroid_of(body);
  model_from_world.translation() = Vector3d(-centre.x(), 0, -centre.z());
  BodyModel model = scanned;
  model.body = transformed(body, model_from_world.matrix());
  std::vector<Isometry3d> new_from_old;
  model.model_from_frame.clear();
  for (std::size_t i = 0; i < world_from_frame.size(); ++i) {
    model.model_from_frame.push_back(model_from_world * world_from_frame[i]);
    if (i < scanned.model_from_frame.size() && scanned.model_from_frame[i].matrix().allFinite())
      new_from_old.push_back(model.model_from_frame[i] * scanned.model_from_frame[i].inverse());
  }
  if (new_from_old.empty()) {  // nothing was tracked: nobody knows where the surroundings are
    model.surroundings = {};
  } else {
    const Isometry3d motion = mean_motion(new_from_old, centroid_of(scanned.body));
    for (auto& point : model.surroundings.points) point = motion * point;
    for (auto& normal : model.surroundings.normals) normal = motion.linear() * normal;
  }
  model.converged = model.floor_seen = true;
  model.loop_closure_m = model.residual_rms_m = 0;
  model.frames_used = static_cast<int>(world_from_frame.size());
  model.note.clear();
  return model;
}

const std::vector<Isometry3d>& scan_poses(const GroundTruth& truth, const std::string& scan) {
  const auto found = truth.scan_world_from_sensor.find(scan);
  if (found == truth.scan_world_from_sensor.end())
    throw InputError("truth", "has no poses of " + scan + "; expected them");
  return found->second;
}

void give_naked(const OracleInput& input, GivenArtifacts& given) {
  given.give<Fuse>("fuse_naked",
                   true_body(input.made.naked.get(), input.truth.naked_body, scan_poses(input.truth, "scan_naked")));
}

void give_user(const OracleInput& input, GivenArtifacts& given) {
  if (!input.made.user) throw InputError("scan_user", "is missing; expected the scan of a user");
  given.give<Fuse>("fuse_user",
                   true_body(input.made.user->get(), input.truth.user_body, scan_poses(input.truth, "scan_user")));
}

// 255 where the surface (world frame) is in sight of a camera.
cv::Mat silhouette(const MeshQuery& surface, const Camera& camera, const Isometry3d& world_from_camera) {
  const cv::Mat grid = normalized_grid(camera);
  cv::Mat mask = cv::Mat::zeros(camera.height, camera.width, CV_8U);
  tbb::parallel_for(0, camera.height, [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      const auto ideal = grid.at<cv::Vec2d>(y, x);
      const Vector3d direction = world_from_camera.linear() * Vector3d(ideal[0], ideal[1], 1);
      if (surface.first_hit(world_from_camera.translation(), direction)) mask.at<std::uint8_t>(y, x) = 255;
    }
  });
  return mask;
}

Mesh joined(Mesh mesh, const Mesh& other) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& triangle : other.triangles) mesh.triangles.push_back(triangle + Vector3i::Constant(first));
  return mesh;
}

// y = 0 of the world in a sensor's frame: n.p + d = 0.
Eigen::Vector4d floor_seen_from(const Isometry3d& world_from_sensor) {
  Eigen::Vector4d plane;
  plane << world_from_sensor.linear().transpose() * Vector3d::UnitY(), world_from_sensor.translation().y();
  return plane;
}

void give_extraction(const OracleInput& input, GivenArtifacts& given) {
  if (input.truth.naked_body.triangles.empty()) throw InputError("truth", "has no body; expected the mannequin's");
  const MeshQuery naked(input.truth.naked_body);
  Mesh all = input.truth.naked_body;
  for (const auto& [slot, garment] : input.truth.garments) all = joined(all, garment.mesh);
  const MeshQuery dressed(all);
  ExtractedViews result = input.made.extracted.get();
  for (const auto& [sensor, pose] : input.truth.world_from_sensor) {
    const auto camera = input.made.calibration.get().sensors.find(sensor);
    if (camera == input.made.calibration.get().sensors.end()) continue;
    const SensorCalibration& known = camera->second;
    ViewMasks& view = result.views[sensor];
    view.found_naked = input.session.naked.count(sensor) > 0;
    view.found_dressed = input.session.dressed.count(sensor) > 0;
    if (view.found_naked) view.naked = silhouette(naked, known.ir, pose);
    if (view.found_dressed) view.dressed = silhouette(dressed, known.ir, pose);
    if (known.color) {
      const Isometry3d world_from_color = pose * known.color_from_ir.inverse();
      if (view.found_naked) view.naked_color = silhouette(naked, *known.color, world_from_color);
      if (view.found_dressed) view.dressed_color = silhouette(dressed, *known.color, world_from_color);
    }
    result.floor_in_sensor[sensor] = floor_seen_from(pose);
  }
  given.give<Extract>("extract", result);
}

void give_registration(const OracleInput& input, GivenArtifacts& given) {
  if (input.truth.world_from_sensor.empty()) throw InputError("truth", "has no poses of sensors; expected them");
  const Isometry3d model_from_world = model_from_world_by_scan(input);
  Registration result;
  for (const auto& [sensor, pose] : input.truth.world_from_sensor) {
    result.model_from_sensor[sensor] = model_from_world * pose;
    result.converged[sensor] = true;
    result.residual_rms_m[sensor] = 0;
    result.inliers[sensor] = 0;
  }
  given.give<Register>("registration", result);
}

const Oracle calibrate_oracle{"calibrate", give_calibration}, naked_oracle{"fuse_naked", give_naked},
    user_oracle{"fuse_user", give_user}, extract_oracle{"extract", give_extraction},
    registration_oracle{"registration", give_registration};

}  // namespace
}  // namespace dressform
