#pragma once
#include <map>
#include <string>

#include "pipeline/run/stage.h"
#include "scenes/capture_session.h"

namespace dressform {

struct MultipathTag {
  static constexpr const char* name = "multipath";
  static constexpr const char* default_variant = "one_bounce";
};

// How much of the predicted error a set of depth images shows.
struct BounceStrength {
  double factor = 0;    // by which predictions are multiplied and taken off; 0: the images are left as they are
  double measured = 0;  // what the floors told, before the decision
  double sigma = 0;     // of `measured`
  int images = 0;       // whose floor told something

  template <class Archive>
  void serialize(Archive& archive) {
    archive(factor, measured, sigma, images);
  }
};

// What is known about light that a time-of-flight camera receives by a detour, and so too late.
struct Multipath {
  double signal_counts = 0;                     // amplitude of a white surface that faces the camera at 1 m
  double floor_albedo = 0, other_albedo = 0;    // in the infrared: for images without an infrared image
  BounceStrength shots;                         // of all sensors, naked and dressed
  std::map<std::string, BounceStrength> scans;  // by name: "scan_naked", "scan_user"

  template <class Archive>
  void serialize(Archive& archive) {
    archive(signal_counts, floor_albedo, other_albedo, shots, scans);
  }
};

// Whether, and how strongly, the depth images of a session suffer from light that bounced. Only sensors whose
// calibration names a time-of-flight model are looked at; all others get the factor 0.
using EstimateMultipath = Stage<MultipathTag, Multipath(const CaptureSession&, const Calibration&)>;

}  // namespace dressform
