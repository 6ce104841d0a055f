#include "synthetic/operator/operator.h"

#include "synthetic/operator/border_picks.h"
#include "synthetic/operator/region_picks.h"

namespace dressform {

Picks operate_on_clothes(const Scene& scene, const RayScene& dressed, const WornGarments& worn,
                         const SyntheticCapture& capture, Seed seed) {
  const double click_px = scene.picking.click_px;
  const Onlookers eyes(dressed, scene.rig, click_px, seed);
  Picks picks;
  std::map<std::string, Seam> seams;
  pick_rims(worn, eyes, picks, seams);
  pick_borders(worn, seams, eyes, picks);
  draw_regions(worn, scene.rig, capture.truth.labels, capture.session.dressed, click_px, seed, picks);
  return picks;
}

}  // namespace dressform
