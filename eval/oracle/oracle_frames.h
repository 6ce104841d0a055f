#pragma once
#include <string>
#include <vector>

#include "eval/oracle/oracle.h"

namespace dressform {

// The run's model frame in the world, told by how the scan was tracked: the rotation nearest to the mean over all
// frames that were, and the shift that keeps the true body's centre where they have it on the mean. Throws InputError
// where no frame was tracked, or the truth has no poses of the scan.
Isometry3d model_from_world_by_scan(const OracleInput& input);

// The same by the sensor that the scores join model and world with: what is put there has no error in the scores.
// Throws InputError where it was not registered.
Isometry3d model_from_world_by_gauge(const OracleInput& input);

// The mean of rigid motions as above; `centre`: the point whose image is the mean of its images.
Isometry3d mean_motion(const std::vector<Isometry3d>& motions, const Vector3d& centre);

Vector3d centroid_of(const Mesh& mesh);  // of the vertices; zero without any

}  // namespace dressform
