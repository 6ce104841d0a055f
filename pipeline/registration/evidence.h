#pragma once
#include <string>
#include <vector>

#include "pipeline/registration/acceptance.h"

namespace dressform {

// What speaks for and against the poses of the accepted views, each judged by what did not make it: free space, floor,
// the other views, the sensor's own noise, and the pose again from parts of the body. Entries of other views are empty.
std::vector<PoseEvidence> gather_evidence(const std::vector<ViewPoints>& views, const ModelTarget& target,
                                          const std::vector<ViewAlignment>& alignments,
                                          const std::vector<char>& accepted);

// Why a pose is not to be believed, in one clause with figures; empty: it is.
std::string problem_with(const PoseEvidence& evidence, const AcceptanceOptions& options);

// Part of a view's mannequin (metres, model frame) that another view looked through: there it saw something more than
// `margin_m` behind, in all pixels next to it. 0 where the two share nothing.
double looked_through_part(const ViewPoints& view, const Isometry3d& model_from_view, const ViewPoints& other,
                           const Isometry3d& model_from_other, double margin_m);

}  // namespace dressform
