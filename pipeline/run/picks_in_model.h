#pragma once
#include <optional>

#include "pipeline/reconstruct.h"

namespace dressform {

// Picks with all their points in the frames "model" and "user". Points whose sensor has no pose, or whose scan's first
// frame was lost, are left out; those of the user are where there is no user.
Picks in_model_frame(const Picks& picks, const BodyModel& naked, const Registration& registration,
                     const BodyModel* user = nullptr);
LazyArtifact<Picks> in_model_frame(const LazyArtifact<Picks>& picks, const LazyArtifact<BodyModel>& naked,
                                   const LazyArtifact<Registration>& registration,
                                   const std::optional<LazyArtifact<BodyModel>>& user = {});

// Throws InputError, naming variant, file and how it is made, where a chosen variant needs picks that are not there.
void check_picks(const ReconstructionOptions& options, const SessionSource& source);

}  // namespace dressform
