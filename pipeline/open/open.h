#pragma once
#include <map>
#include <string>
#include <vector>

#include "pipeline/run/stage.h"
#include "pipeline/segment/segment.h"
#include "pipeline/surface/surface.h"

namespace dressform {

struct Rim {
  std::string name;              // "neck", "left_cuff", "right_cuff", "hem", "waist", "left_ankle", "right_ankle"
  std::vector<Vector3d> points;  // closed, model frame
  bool observed = true;          // false where no view saw the edge (a waist under a shirt)

  template <class Archive>
  void serialize(Archive& archive) {
    archive(name, points, observed);
  }
};
struct OpenGarment {
  Mesh mesh;              // open, manifold, one component; shirt 4 loops, trousers 3, skirt 2
  std::vector<Rim> rims;  // one per loop

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mesh, rims);
  }
};
struct OpenGarments {
  std::map<std::string, OpenGarment> garments;  // "top", "bottom"

  template <class Archive>
  void serialize(Archive& archive) {
    archive(garments);
  }
};

struct OpenTag {
  static constexpr const char* name = "open";
  static constexpr const char* default_variant = "limb_spline";
};
using Open = Stage<OpenTag, OpenGarments(const CaptureSession&, const Calibration&, const BodyModel& naked,
                                         const Registration&, const Segmentation&, const ClosedGarments&)>;

}  // namespace dressform
