#pragma once
#include "pipeline/registration/acceptance.h"
#include "pipeline/registration/initial_poses.h"

namespace dressform {

// What the variants that work on clouds (alignment/open3d_icp.h) share.

// Mannequin and floor of a view, sensor frame, with normals; `floor`: whether the floor is among them.
PointCloud view_cloud(const ViewPoints& view, bool floor = true);

// The naked model's vertices with their normals, model frame, and where it has a floor and `floor` asks for it, a grid
// of the floor round it.
PointCloud model_cloud(const ModelTarget& target, bool floor = true);

// How a view fits in a pose, by the loss of `gate`: as every variant measures it.
ViewAlignment measured_at(const ViewPoints& view, const ModelTarget& target, const Isometry3d& model_from_sensor,
                          const ModelGate& gate);

// Registration of the alignments that are acceptable, in line with one another, and not contradicted by evidence.
Registration judged(const std::vector<ViewPoints>& views, const ModelTarget& target,
                    const std::vector<ViewAlignment>& alignments, const AcceptanceOptions& options);

}  // namespace dressform
