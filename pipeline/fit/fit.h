#pragma once
#include <map>
#include <string>
#include <vector>

#include "pipeline/fuse/fuse.h"
#include "pipeline/run/stage.h"
#include "pipeline/texture/texture.h"

namespace dressform {

struct FittedGarments {
  std::map<std::string, TexturedMesh> garments;  // on the user, in the user scan's model frame; same triangles and UV
  Mesh deformed_body;                            // the naked model moved by the same function
  double body_rms_m = 0;                         // deformed body to user body
  int control_points = 0;
  int foldovers = 0;  // triangles whose normal turned by more than 90 degrees

  template <class Archive>
  void serialize(Archive& archive) {
    archive(garments, deformed_body, body_rms_m, control_points, foldovers);
  }
};

struct FitTag {
  static constexpr const char* name = "fit";
  static constexpr const char* default_variant = "rbf";
};
using Fit = Stage<FitTag, FittedGarments(const BodyModel& naked, const BodyModel& user, const TexturedGarments&)>;

}  // namespace dressform
