#pragma once
#include <vector>

#include "pipeline/open/open_scene.h"

namespace dressform {

// How many views see a place of a closed surface labelled as the garment, and how many as something else. Per vertex.
struct PlaceVotes {
  std::vector<double> garment, elsewhere;
};

// A view votes on vertices that it sees at a cosine of at least `least_cosine` to their normals, with nothing nearer by
// more than `in_front_m` in its depth. `tucked`: the other garment is worn over this one, and where it shows it says
// nothing. What a view looks through is elsewhere.
PlaceVotes place_votes(const Mesh& closed, Label garment, bool tucked, const OpenScene& scene, double in_front_m,
                       double least_cosine);

}  // namespace dressform
