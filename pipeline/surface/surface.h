#pragma once
#include <map>
#include <string>

#include "pipeline/fill/fill.h"
#include "pipeline/run/stage.h"

namespace dressform {

struct ClosedGarment {
  Mesh mesh;           // closed, manifold, one component, outward, model frame
  PointCloud support;  // the points it was made from, outliers removed; views = index into CaptureSession::sensors

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mesh, support);
  }
};
struct ClosedGarments {
  std::map<std::string, ClosedGarment> garments;  // "top", "bottom"
  bool tucked = false;                            // both are there, and the top is worn under the bottom

  template <class Archive>
  void serialize(Archive& archive) {
    archive(garments, tucked);
  }
};

struct SurfaceTag {
  static constexpr const char* name = "surface";
  static constexpr const char* default_variant = "layer";
};
using Surface = Stage<SurfaceTag, ClosedGarments(const CaptureSession&, const Calibration&, const BodyModel& naked,
                                                 const Registration&, const FilledViews&)>;

}  // namespace dressform
