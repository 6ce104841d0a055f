#pragma once
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/geometry/intersections.h"
#include "pipeline/geometry/mesh_query.h"
#include "scenes/mesh.h"

namespace dressform {

struct PushOutParams {
  double gap_m = 0.003;
  int rounds = 60;            // of pushing at most
  int diffusion_rounds = 12;  // rings of neighbours over which a push fades
};

struct PushedOut {
  std::vector<Vector3d> vertices;
  int rounds = 0;
  int intersecting_pairs = 0;  // left, by exact predicates
};

// The garment's vertices moved out of the closed body until no triangle of one meets a triangle of the other. Vertices
// nearer than the gap go to the nearest point of the surface and the gap beyond it; where that would turn the cloth
// over (a thin arm, entered from behind) they leave the way the cloth faces; triangles that are cut between their
// vertices are lifted over what cuts them; what is still cut after many rounds is smoothed between pushes. Pushes fade
// over the neighbours. `beside` marks triangles of the body that lie beside the cloth, not inside it (bare arms): cloth
// in them leaves towards its own inside.
PushedOut push_out(const Mesh& garment, const MeshQuery& body, const IntersectionFinder& finder,
                   const std::vector<char>& beside, const PushOutParams& params);

}  // namespace dressform
