#include "pipeline/alignment/open3d_icp.h"

#include <omp.h>
#include <open3d/geometry/KDTreeFlann.h>
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/ColoredICP.h>
#include <open3d/pipelines/registration/FastGlobalRegistration.h>
#include <open3d/pipelines/registration/Feature.h>
#include <open3d/pipelines/registration/GeneralizedICP.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Random.h>

#include <Eigen/SVD>
#include <mutex>

namespace dressform {
namespace {

namespace o3d = open3d::pipelines::registration;

constexpr int kLeastOfFeatures = 50;                         // points, for features to say anything
constexpr int kNormalNeighbours = 30, kMostOfFeature = 100;  // of Open3D's own examples
constexpr double kLeastFitness = 0.1;  // of the source's points near the target, for a match to be one
constexpr float kGrey = 0.5f;

// This thread's parallel regions have one thread each, even those that ask for more.
class OneOpenMpThread {
 public:
  OneOpenMpThread() : threads_(omp_get_max_threads()), levels_(omp_get_max_active_levels()) {
    omp_set_num_threads(1);
    omp_set_max_active_levels(0);
  }
  ~OneOpenMpThread() {
    omp_set_num_threads(threads_);
    omp_set_max_active_levels(levels_);
  }
  OneOpenMpThread(const OneOpenMpThread&) = delete;
  OneOpenMpThread& operator=(const OneOpenMpThread&) = delete;

 private:
  int threads_, levels_;
};

open3d::geometry::PointCloud to_open3d(const PointCloud& cloud) {
  open3d::geometry::PointCloud result;
  result.points_ = cloud.points;
  result.normals_ = cloud.normals;
  for (const Vector3f& color : cloud.colors) result.colors_.push_back(color.cast<double>());
  return result;
}

PointCloud from_open3d(const open3d::geometry::PointCloud& cloud) {
  PointCloud result;
  result.points = cloud.points_;
  result.normals = cloud.normals_;
  for (const Vector3d& color : cloud.colors_) result.colors.push_back(color.cast<float>());
  return result;
}

// The nearest rigid motion: products of many steps are none by a few ulps.
Isometry3d rigid(const Eigen::Matrix4d& matrix, const Isometry3d& otherwise) {
  if (!matrix.allFinite()) return otherwise;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix.topLeftCorner<3, 3>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Isometry3d result = Isometry3d::Identity();
  result.linear() = svd.matrixU() * svd.matrixV().transpose();
  if (result.linear().determinant() < 0) return otherwise;
  result.translation() = matrix.topRightCorner<3, 1>();
  return result;
}

o3d::ICPConvergenceCriteria until(const IcpOptions& options) { return {1e-6, 1e-6, options.iterations}; }

}  // namespace

Isometry3d generalized_icp(const PointCloud& source, const PointCloud& target, const Isometry3d& initial,
                           const IcpOptions& options) {
  if (source.points.empty() || target.points.empty()) return initial;
  const OneOpenMpThread pinned;
  return rigid(o3d::RegistrationGeneralizedICP(to_open3d(source), to_open3d(target), options.reach_m, initial.matrix(),
                                               o3d::TransformationEstimationForGeneralizedICP(), until(options))
                   .transformation_,
               initial);
}

Isometry3d plane_icp(const PointCloud& source, const PointCloud& target, const Isometry3d& initial,
                     const IcpOptions& options) {
  if (source.points.empty() || target.points.empty()) return initial;
  const OneOpenMpThread pinned;
  return rigid(o3d::RegistrationICP(to_open3d(source), to_open3d(target), options.reach_m, initial.matrix(),
                                    o3d::TransformationEstimationPointToPlane(), until(options))
                   .transformation_,
               initial);
}

Isometry3d color_icp(const PointCloud& source, const PointCloud& target, const Isometry3d& initial,
                     const IcpOptions& options, double geometry_weight) {
  if (source.points.empty() || target.points.empty()) return initial;
  const OneOpenMpThread pinned;
  return rigid(o3d::RegistrationColoredICP(to_open3d(source), to_open3d(target), options.reach_m, initial.matrix(),
                                           o3d::TransformationEstimationForColoredICP(geometry_weight), until(options))
                   .transformation_,
               initial);
}

std::optional<Isometry3d> fast_global(const PointCloud& source, const PointCloud& target, double voxel_m,
                                      std::uint64_t seed) {
  const OneOpenMpThread pinned;
  const auto from = to_open3d(source).VoxelDownSample(voxel_m), to = to_open3d(target).VoxelDownSample(voxel_m);
  if (from->points_.size() < kLeastOfFeatures || to->points_.size() < kLeastOfFeatures) return {};
  const open3d::geometry::KDTreeSearchParamHybrid reach(5 * voxel_m, kMostOfFeature);
  const auto from_features = o3d::ComputeFPFHFeature(*from, reach), to_features = o3d::ComputeFPFHFeature(*to, reach);
  o3d::FastGlobalRegistrationOption option;
  option.maximum_correspondence_distance_ = 0.5 * voxel_m;
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  open3d::utility::random::Seed(static_cast<int>(seed & 0x7fffffff));
  const auto found =
      o3d::FastGlobalRegistrationBasedOnFeatureMatching(*from, *to, *from_features, *to_features, option);
  const auto fit = o3d::EvaluateRegistration(*from, *to, voxel_m, found.transformation_);
  if (!found.transformation_.allFinite() || fit.fitness_ < kLeastFitness) return {};
  return rigid(found.transformation_, Isometry3d::Identity());
}

PointCloud voxel_thinned(const PointCloud& cloud, double voxel_m) {
  return cloud.points.empty() ? cloud : from_open3d(*to_open3d(cloud).VoxelDownSample(voxel_m));
}

PointCloud colored_by(const PointCloud& cloud, const PointCloud& seen, double reach_m) {
  PointCloud result = cloud;
  result.colors.assign(cloud.points.size(), Vector3f::Constant(kGrey));
  if (seen.points.empty()) return result;
  const auto searched = to_open3d(seen);  // Open3D's tree looks at the cloud's own points: it has to outlive the tree
  const open3d::geometry::KDTreeFlann near_seen(searched);
  std::vector<int> indices;
  std::vector<double> squared;
  open3d::geometry::PointCloud colored;
  std::vector<char> has_color(cloud.points.size(), 0);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    near_seen.SearchRadius(cloud.points[i], reach_m, indices, squared);
    Vector3f sum = Vector3f::Zero();
    int count = 0;
    for (const int k : indices)
      if (seen.normals[k].dot(cloud.normals[i]) > 0) sum += seen.colors[k], ++count;
    if (count == 0) continue;
    has_color[i] = 1;
    result.colors[i] = sum / static_cast<float>(count);
    colored.points_.push_back(cloud.points[i]);
    colored.colors_.push_back(result.colors[i].cast<double>());
  }
  if (colored.points_.empty()) return result;
  const open3d::geometry::KDTreeFlann near_colored(colored);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (!has_color[i] && near_colored.SearchKNN(cloud.points[i], 1, indices, squared) > 0)
      result.colors[i] = colored.colors_[indices[0]].cast<float>();
  return result;
}

}  // namespace dressform
