#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "pipeline/alignment/open3d_icp.h"
#include "pipeline/imaging/color_mapping.h"
#include "pipeline/registration/view_clouds.h"

namespace dressform {
namespace {

struct ColoredIcpParams {
  int points = 10000;
  double geometry_weight = 0.968;
  double coarse_m = 0.04, middle_m = 0.02, fine_m = 0.01;
  int rounds = 2;
  LossWidths loss;
  InitialPoseOptions initial;
  AcceptanceOptions acceptance;
};
template <class V>
void fields(V& v, ColoredIcpParams& p) {
  v("points", p.points, 200, 200000, "", "of the mannequin used in every view");
  v("geometry_weight", p.geometry_weight, 0, 1, "", "of distances against colours; 0.968 is the paper's");
  v("coarse_m", p.coarse_m, 0.005, 0.2, "m", "voxels and reach at first");
  v("middle_cloud_m", p.middle_m, 0.003, 0.1, "m", "voxels and reach then");
  v("fine_m", p.fine_m, 0.002, 0.1, "m", "voxels and reach at last");
  v("rounds", p.rounds, 1, 10, "", "of colouring the model by the other views and aligning a view with it");
  loss_fields(v, p.loss);
  v("headings", p.initial.headings, 4, 360, "", "starts round the circle");
  v("prior_reach_deg", p.initial.prior_reach_deg, 5.0, 180.0, "deg", "how far a view may turn from the rig prior");
  acceptance_fields(v, p.acceptance);
}

constexpr std::array<int, 3> kIterations = {50, 30, 14};  // of coarse, middle and fine, as in Open3D's example
constexpr double kColorReach_m = 0.008;                   // from a place of the model to what a view saw there

// The view's points whose colours are known, sensor frame. None without a colour image.
PointCloud colored_view(const CaptureSession& session, const Calibration& calibration, const ViewPoints& view,
                        bool floor) {
  const PointCloud cloud = view_cloud(view, floor);
  PointCloud colored;
  const auto shot = session.naked.find(view.sensor);
  if (shot == session.naked.end() || shot->second.color.empty()) return {};
  const SensorCalibration& sensor = calibration.sensors.at(view.sensor);
  if (!sensor.color) return {};
  const cv::Mat depth = corrected_depth_mm(shot->second.depth_mm, sensor);
  const ColorDepthMap map = color_depth_map(depth, sensor);
  const cv::Mat pixels = color_of_depth_pixels(depth, sensor, &map);
  std::vector<int> indices = view.body;
  if (floor) indices.insert(indices.end(), view.floor.begin(), view.floor.end());
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const auto& at = pixels.at<cv::Vec2f>(indices[k] / view.map.camera.width, indices[k] % view.map.camera.width);
    if (std::isnan(at[0])) continue;
    const cv::Point pixel(cvRound(at[0]), cvRound(at[1]));
    if (!cv::Rect({0, 0}, shot->second.color.size()).contains(pixel)) continue;
    const auto& bgr = shot->second.color.at<cv::Vec3b>(pixel);
    colored.points.push_back(cloud.points[k]);
    colored.normals.push_back(cloud.normals[k]);
    colored.colors.emplace_back(bgr[2] / 255.f, bgr[1] / 255.f, bgr[0] / 255.f);
  }
  return colored;
}

void add_moved(const PointCloud& cloud, const Isometry3d& pose, PointCloud& into) {
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    into.points.push_back(pose * cloud.points[i]);
    into.normals.push_back(pose.linear() * cloud.normals[i]);
    into.colors.push_back(cloud.colors[i]);
  }
}

// From coarse to fine; a view without colours by distances alone.
Isometry3d aligned(const PointCloud& plain, const PointCloud& colored, const PointCloud& model,
                   const PointCloud& seen_by_others, Isometry3d pose, const ColoredIcpParams& params) {
  const PointCloud target = colored_by(model, seen_by_others, kColorReach_m);
  const std::array<double, 3> voxels = {params.coarse_m, params.middle_m, params.fine_m};
  for (std::size_t k = 0; k < voxels.size(); ++k) {
    const IcpOptions options{voxels[k], kIterations[k]};
    if (colored.points.empty() || seen_by_others.points.empty())
      pose = plane_icp(voxel_thinned(plain, voxels[k]), voxel_thinned(model, voxels[k]), pose, options);
    else
      pose = color_icp(voxel_thinned(colored, voxels[k]), voxel_thinned(target, voxels[k]), pose, options,
                       params.geometry_weight);
  }
  return pose;
}

// Every view against the model as the other views colour it: distances and colours at once (Park, Zhou and Koltun,
// "Colored point cloud registration revisited", ICCV 2017), by Open3D with the voxels of its example. A depth scan has
// no colours of its own, so that they come from what two views share. Views without a colour image go by distances
// alone.
Registration colored_icp(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                         const ExtractedViews& extracted, const ColoredIcpParams& params) {
  check_registration_input(session, naked);
  const auto views = view_points(session, calibration, extracted, params.points);
  const ModelTarget target(naked);
  const PointCloud model = model_cloud(target);
  const ModelGate gate{params.loss.narrow_m, params.loss.normal_cosine};
  auto alignments = initial_poses(views, target, params.initial);
  std::vector<PointCloud> plain(views.size()), colored(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (!alignments[v].valid) return;
    plain[v] = view_cloud(views[v], target.has_floor());
    colored[v] = colored_view(session, calibration, views[v], target.has_floor());
  });
  for (int round = 0; round < params.rounds; ++round) {
    const auto before = alignments;  // every view against the others as they stood
    tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
      if (!before[v].valid) return;
      PointCloud others;
      for (std::size_t w = 0; w < views.size(); ++w)
        if (w != v && before[w].valid) add_moved(colored[w], before[w].model_from_sensor, others);
      const Isometry3d pose = aligned(plain[v], colored[v], model, others, before[v].model_from_sensor, params);
      alignments[v] = measured_at(views[v], target, pose, gate);
    });
  }
  return judged(views, target, alignments, params.acceptance);
}

const Register::Variant colored_icp_variant{"colored_icp", colored_icp};

}  // namespace
}  // namespace dressform
