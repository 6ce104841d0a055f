#pragma once
#include <cstdint>
#include <optional>

#include "scenes/camera.h"
#include "scenes/mesh.h"

namespace dressform {

// Open3D's registrations of two clouds, behind the project's own types. Metres; every cloud with normals. Each runs on
// one thread of OpenMP, whatever the calling thread was given: Open3D adds up equations in the order in which threads
// end. Every result is target_from_source; where nothing is within reach it is the initial one.

struct IcpOptions {
  double reach_m = 0.02;  // farthest pair
  int iterations = 30;
};

// Segal, Haehnel and Thrun, "Generalized-ICP", RSS 2009: planes against planes, their covariances from the normals.
Isometry3d generalized_icp(const PointCloud& source, const PointCloud& target, const Isometry3d& initial,
                           const IcpOptions& options);

// Chen and Medioni, ICRA 1991, as Open3D has it.
Isometry3d plane_icp(const PointCloud& source, const PointCloud& target, const Isometry3d& initial,
                     const IcpOptions& options);

// Park, Zhou and Koltun, "Colored point cloud registration revisited", ICCV 2017. Both clouds have colours;
// geometry_weight: 0 to 1, of distances against colours.
Isometry3d color_icp(const PointCloud& source, const PointCloud& target, const Isometry3d& initial,
                     const IcpOptions& options, double geometry_weight);

// Zhou, Park and Koltun, "Fast global registration", ECCV 2016, by Rusu's fast point feature histograms (ICRA 2009), of
// clouds thinned to voxel_m; radii of normals and features are as usual twice and five times that. No start is needed.
// Empty for fewer than 50 points in either cloud, or where too few features agree. Seeded: one at a time, because
// Open3D has one engine of random numbers for all threads.
std::optional<Isometry3d> fast_global(const PointCloud& source, const PointCloud& target, double voxel_m,
                                      std::uint64_t seed);

// The same cloud thinned to one point, normal and colour a voxel.
PointCloud voxel_thinned(const PointCloud& cloud, double voxel_m);

// `cloud` in the colours of `seen`: the mean of what lies within reach_m and has a normal on the same side, else the
// colour of the nearest point that has one; grey throughout where nothing is within reach of any.
PointCloud colored_by(const PointCloud& cloud, const PointCloud& seen, double reach_m);

}  // namespace dressform
