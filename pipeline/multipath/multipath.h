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
  bool infrared_scaled = true;                  // whether infrared images have that scale; else they are not used
  double floor_albedo = 0, other_albedo = 0;    // in the infrared: for images without an infrared image
  BounceStrength shots;                         // of all sensors, naked and dressed
  std::map<std::string, BounceStrength> scans;  // by name: "scan_naked", "scan_user"

  template <class Archive>
  void serialize(Archive& archive) {
    archive(signal_counts, infrared_scaled, floor_albedo, other_albedo, shots, scans);
  }
};

// Whether, and how strongly, the depth images of a session suffer from light that bounced.
//
// In: raw depth (uint16, millimetres, 0 = none) and infrared (uint16) of the naked and dressed shots, the scans' depth,
// and the cameras. Only sensors whose calibration names a time-of-flight device (scenes/devices) are looked at.
// Infrared is optional; images whose counts would make nearly every surface black, or white, have another scale than
// the driver gives them. Then, as without any, surfaces are taken to have a usual albedo. Out: factors on predicted
// errors, for all shots and for each scan; 0 wherever too little speaks for it, and then all images are left as they
// are, byte for byte. The corrected images are made by pipeline/multipath/apply.h. Throws nothing of its own: images
// that tell nothing count for nothing. Fuchs, "Multipath interference compensation in time-of-flight camera images",
// ICPR 2010.
using EstimateMultipath = Stage<MultipathTag, Multipath(const CaptureSession&, const Calibration&)>;

}  // namespace dressform
