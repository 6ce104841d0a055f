#pragma once
#include <string>
#include <vector>

#include "eval/gate/environment.h"

namespace dressform {

// The bytes that one step of a run gave. Steps stand in the order of the run: capture, truth, the stages by their
// labels, out, scores, and each picture.
struct StepBytes {
  std::string step;     // "capture", "fuse_naked", ..., "scores", "image result_user"
  std::string content;  // hash of the result
  std::string inputs;   // hash of what was asked (variant, parameters, seed) and of the results it was given; no code
};

enum class BytesState {
  none_kept,          // the golden was accepted before bytes were kept
  identical,          // every step gave the bytes of the accepted run, whatever the environment
  changed,            // in the same environment some did not
  other_environment,  // some did not, but the environment is another one, which explains it as well
};

struct BytesResult {
  BytesState state = BytesState::none_kept;
  std::vector<std::string> changed;  // steps with other bytes, that are new, or that are gone, in the order of the run
  // Of those, the ones with the inputs of then: where a change began. The first is to blame. Empty when nothing
  // changed.
  std::vector<std::string> origins;
  std::string environment;  // what differs; empty: nothing
};

BytesResult compare_bytes(const std::vector<StepBytes>& then, const Environment& environment_then,
                          const std::vector<StepBytes>& now, const Environment& environment_now);

// "identical", "changed, first at segment (12 of 21 steps)", "no bytes kept: accept to keep them", ...
std::string bytes_text(const BytesResult& result);

}  // namespace dressform
