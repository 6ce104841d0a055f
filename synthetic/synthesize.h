#pragma once
#include <functional>
#include <string>

#include "scenes/capture_session.h"
#include "scenes/ground_truth.h"
#include "scenes/picks.h"
#include "scenes/scene.h"

namespace dressform {

struct SyntheticCapture {
  CaptureSession session;
  GroundTruth truth;
  std::optional<Picks> picks;  // of an operator, where the scene has one
};

// Captures the scene with the scene's sensor model. Deterministic in (scene, seed), whatever the thread count.
// `progress(done, total, what)` is called from the calling thread as shots are finished; it may be empty.
using SynthesisProgress = std::function<void(int done, int total, const std::string& what)>;
SyntheticCapture synthesize(const Scene& scene, Seed seed, const SynthesisProgress& progress = {});

// The same session with nothing but its boards and calibration, and the true calibration: the bytes are those of
// synthesize(). Throws InputError where the scene has no boards.
SyntheticCapture synthesize_boards(const Scene& scene, Seed seed, const SynthesisProgress& progress = {});

}  // namespace dressform
