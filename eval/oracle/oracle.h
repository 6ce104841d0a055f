#pragma once
#include <string>
#include <vector>

#include "pipeline/reconstruct.h"
#include "scenes/ground_truth.h"

namespace dressform {

// A run whose stage is to be replaced by truth: what went before the stage is taken from it.
struct OracleInput {
  const Reconstruction& made;
  const CaptureSession& session;
  const GroundTruth& truth;
};

// What a stage would have given without an error of its own, for one run: then the end scores are the ceiling of that
// stage, all others as they are. The pipeline is handed a finished result and never the truth.
//   const Oracle open_oracle{"open", give_open};
struct Oracle {
  using Give = void (*)(const OracleInput& input, GivenArtifacts& given);
  Oracle(const char* label, Give give);
};

// The stages that have one, by label ("fuse_naked"), in the order of the pipeline. Stages without: what they should
// have given is in no truth (multipath, landmarks, fill, fit, correct).
std::vector<std::string> oracle_labels();

// Throws InputError where `where` names a stage that has no oracle, with those that have.
void check_oracle(const std::string& where, const std::string& label);

// Gives the true result of one stage. Throws InputError where the truth lacks what it takes, or the run did not get so
// far that it can be said in the run's own frame.
void give_truth(const std::string& label, const OracleInput& input, GivenArtifacts& given);

// The run of `options` with the stages in `labels` replaced by truth, one after the other in the pipeline's order; the
// truth of a stage is told in the frames of the run that has the earlier ones already.
Reconstruction reconstruct_with_truth(const SessionSource& source, const ReconstructionOptions& options,
                                      ArtifactStore& store, const StageProgress& progress,
                                      const std::vector<std::string>& labels, const GroundTruth& truth);

}  // namespace dressform
