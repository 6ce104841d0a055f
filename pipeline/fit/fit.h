#pragma once
#include <map>
#include <string>
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/garment/garment_layout.h"
#include "pipeline/run/stage.h"
#include "pipeline/texture/texture.h"

namespace dressform {

struct FittedGarments {
  std::map<std::string, TexturedMesh> garments;  // on the user, in the user scan's model frame; same triangles and UV
  GarmentLayouts layouts;                        // of these on the user's body
  Mesh deformed_body;                            // the naked model moved by the same function
  double body_rms_m = 0;                         // deformed body to user body
  int control_points = 0;
  int foldovers = 0;  // triangles whose normal turned by more than 90 degrees

  template <class Archive>
  void serialize(Archive& archive) {
    archive(garments, layouts, deformed_body, body_rms_m, control_points, foldovers);
  }
};

struct FitTag {
  static constexpr const char* name = "fit";
  static constexpr const char* default_variant = "rbf";
};
// The garments taken from the mannequin to the user. In: both bodies with their landmarks, each in its own model frame
// (m, y up), the garments and their layouts on the mannequin. Out: m, model frame of the user's scan: the same
// triangles and texture coordinates, vertices moved, and the naked body moved alike. Throws InputError for a body
// without triangles or trunk, and for a garment without layout. The thesis (section 3.6) uses radial basis functions
// (Carr et al., SIGGRAPH 2001) on pairs picked by hand.
using Fit = Stage<FitTag, FittedGarments(const KnownBody& naked, const KnownBody& user, const TexturedGarments&,
                                         const GarmentLayouts&)>;

}  // namespace dressform
