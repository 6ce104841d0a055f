#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "eval/score/evaluate.h"
#include "scenes/capture_session.h"
#include "scenes/random.h"
#include "scenes/serialize.h"

namespace dressform {

// Where a fault is put: which sensor, which garment, which spot, in which direction. Drawn from a seed, so that the
// same placement is the same fault.
class Placement {
 public:
  Placement(Seed seed, const std::string& fault) : seed_(seed), stream_(stream_of(fault.c_str())) {}

  double uniform(std::uint64_t index) const { return dressform::uniform(seed_, stream_, index); }  // (0, 1)
  double normal(std::uint64_t index) const { return dressform::normal(seed_, stream_, index); }
  Vector3d direction(std::uint64_t index) const;  // of unit length, all alike
  // One of a map's keys; empty where it has none.
  template <class Map>
  std::string one_of(const Map& map, std::uint64_t index = 0) const {
    if (map.empty()) return {};
    auto at = map.begin();
    std::advance(at, static_cast<std::ptrdiff_t>(uniform(index) * static_cast<double>(map.size())));
    return at->first;
  }

 private:
  Seed seed_;
  std::uint64_t stream_;
};

// What the scorer is given.
struct ScorerInput {
  RunOutputs outputs;
  GroundTruth truth;
  EvaluateOptions options;
};

// A fault that is put into the result of one step, in a size that can be told: exactly one of the functions is set.
// Nothing in the pipeline knows of it.
struct Fault {
  std::string step;           // where: "capture", the label of a stage, "scores", "image"
  std::string name;           // what: "view_moved"
  std::string unit;           // of its size: "mm", "deg", "px", "levels", "%", "count", "times"
  std::vector<double> sizes;  // small, medium, large; of faults that are there or not, one
  std::string what;           // in a clause

  std::function<std::string(const std::string& bytes, double size, const Placement&)> on_artifact;
  std::function<void(CaptureSession&, double size, const Placement&)> on_capture;
  std::function<void(ScorerInput&, double size, const Placement&)> on_scorer;
  std::function<void(Scores&, double size, const Placement&)> on_scores;
  std::function<void(cv::Mat&, double size, const Placement&)> on_image;

  std::string id() const { return step + "." + name; }
};

// A fault in the artifact of a stage that makes a T.
template <class T, class Edit>
Fault artifact_fault(const std::string& step, const std::string& name, const std::string& unit,
                     std::vector<double> sizes, const std::string& what, Edit edit) {
  Fault fault{step, name, unit, std::move(sizes), what, {}, {}, {}, {}, {}};
  fault.on_artifact = [edit](const std::string& bytes, double size, const Placement& place) {
    T value = from_bytes<T>(bytes);
    edit(value, size, place);
    return to_bytes(value);
  };
  return fault;
}

// The library, in the order of the pipeline.
std::vector<Fault> all_faults();

// Its parts.
std::vector<Fault> capture_faults();      // capture, calibrate, multipath
std::vector<Fault> body_faults();         // fuse_naked, landmarks_naked, fuse_user, landmarks_user
std::vector<Fault> view_faults();         // extract, registration
std::vector<Fault> cloth_image_faults();  // segment, fill
std::vector<Fault> garment_faults();      // surface, open, texture
std::vector<Fault> fitted_faults();       // fit, correct
std::vector<Fault> scorer_faults();       // scores, image

// The faults whose id or step is among `names`; all for none. Throws InputError naming one that is not there.
std::vector<Fault> chosen_faults(const std::vector<std::string>& names);

// "small", "medium" or "large" of a fault's k-th size; faults of one size are large.
std::string size_word(const Fault& fault, std::size_t k);

}  // namespace dressform
