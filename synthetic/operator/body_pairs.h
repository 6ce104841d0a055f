#pragma once
#include "scenes/picks.h"
#include "scenes/scene.h"
#include "synthetic/body/body.h"

namespace dressform {

// A body and the walk round it: world from IR camera, by frame.
struct ScannedBody {
  const Body& body;
  const std::vector<Isometry3d>& path;
};

// Picks `control` on the mannequin and `target` on the user: the same 200 places (thesis, section 3.6), 120 round the
// trunk, 48 on the legs, 32 on the arms, each in the frame of the scan's first frame. Left out are those that no frame
// of the walk sees on both.
void pick_body_pairs(const ScannedBody& naked, const ScannedBody& user, double click_mm, Seed seed, Picks& picks);

}  // namespace dressform
