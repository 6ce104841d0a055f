#pragma once
#include <utility>
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/body/trunk_outline.h"
#include "scenes/mesh.h"

namespace dressform {

// A body with its landmarks and its sections at hand, for who measures girths. Metres, model frame, y up.
struct StandingBody {
  Mesh mesh;
  Landmarks landmarks;
  Sections sections;

  // Sections are cut again: no landmark is found here.
  explicit StandingBody(const KnownBody& known)
      : mesh(known.body), landmarks(known.landmarks), sections(horizontal_sections(known.body)) {}
  StandingBody(const Mesh& body, const Landmarks& known, Sections cut)
      : mesh(body), landmarks(known), sections(std::move(cut)) {}

  const SectionLoop* trunk_loop(double y) const;  // the largest loop of the level; null where there is none
  TrunkOutline outline_at(double y) const;        // of the level; empty where there is none
};

// Height at part t of the way along the marks (at least two): 0 the first, 1 the second; in between linear.
double height_at(const std::vector<double>& marks, double t);

}  // namespace dressform
