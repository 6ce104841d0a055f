#pragma once
#include <map>
#include <string>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/fit/fit.h"
#include "pipeline/run/stage.h"

namespace dressform {

struct CorrectedGarments {
  std::map<std::string, TexturedMesh> garments;  // on the user; same triangles and UV
  std::map<std::string, int> moved_vertices;
  std::map<std::string, double> largest_move_m;
  std::map<std::string, int> intersecting_pairs;  // garment/body triangle pairs left, by exact predicates
  std::map<std::string, bool> converged;          // no triangle of the garment cuts the body

  template <class Archive>
  void serialize(Archive& archive) {
    archive(garments, moved_vertices, largest_move_m, intersecting_pairs, converged);
  }
};

struct CorrectTag {
  static constexpr const char* name = "correct";
  static constexpr const char* default_variant = "signed_distance_smooth";
};
// Penetration taken away: the fitted garments pushed out of the user's body. In: the user's body with its landmarks,
// the garments on it (m, model frame of the user's scan). Out: the same frame, the same triangles and texture
// coordinates, vertices moved. Throws InputError for a body without triangles. The thesis (section 3.6) tests vertices
// against the nearest face's centroid; distances here are signed by pseudonormals (Baerentzen and Aanaes, TVCG 2005).
using Correct = Stage<CorrectTag, CorrectedGarments(const KnownBody& user, const FittedGarments&)>;

}  // namespace dressform
