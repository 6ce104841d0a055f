#include "pipeline/segment/cloth.h"
#include "pipeline/segment/labelled_views.h"
#include "pipeline/segment/segment.h"
#include "pipeline/segment/top_bottom.h"
#include "pipeline/segment/view_evidence.h"

namespace dressform {
namespace {

struct JointMrfParams {
  EvidenceParams evidence;
  ClothParams cloth;
  TopBottomParams hem_boundary;
};
template <class V>
void fields(V& v, JointMrfParams& p) {
  v("moved_mm", p.evidence.moved_mm, 1, 100, "mm", "depth change of head and hands beyond which the mannequin moved");
  v("stand_mm", p.evidence.stand_mm, 5, 300, "mm", "unchanged and further from the naked body: the stand");
  v("skin_sigma_mm", p.cloth.skin_sigma_mm, 0.5, 20, "mm", "spread of bare skin about the naked body");
  v("shape_nats", p.cloth.shape_nats, 0, 20, "nats", "most that the offset of one pixel may say about cloth");
  v("change_nats", p.cloth.change_nats, 0, 20, "nats", "most that the colour change of one pixel may say about cloth");
  v("color_nats", p.cloth.color_nats, 0, 20, "nats", "most that the colour of one pixel may say about cloth");
  v("smoothness", p.cloth.smoothness, 0, 100, "nats", "price of an edge between cloth and skin through even colour");
  v("speck_mm2", p.cloth.speck_mm2, 0, 10000, "mm^2", "smaller pieces join what surrounds them");
  v("island_mm2", p.cloth.island_mm2, 0, 50000, "mm^2", "smaller pieces of skin that cloth encloses are print");
  v("raised_mm", p.cloth.raised_mm, 0.5, 100, "mm", "pieces of skin of a larger median offset are cloth of its colour");
  v("cloth_rounds", p.cloth.rounds, 1, 10, "", "rounds of learning the colours of skin and cloth");
  v("hem_boundary_color_nats", p.hem_boundary.color_nats, 0, 20, "nats",
    "most that the colour of one pixel may say about top");
  v("hem_boundary_row_price", p.hem_boundary.row_price, 0.01, 100, "nats",
    "price of 5 mm of change of the hem's height");
  v("hem_boundary_band_mm", p.hem_boundary.band_mm, 5, 300, "mm",
    "band round the hem in which colour decides by pixel");
  v("hem_boundary_smoothness", p.hem_boundary.smoothness, 0, 100, "nats", "price of an edge between top and bottom");
  v("least_mm2", p.hem_boundary.least_mm2, 0, 1e6, "mm^2",
    "cloth on chest or legs below which there is no such garment");
  v("hem_boundary_least_nats", p.hem_boundary.least_nats, 0, 3, "nats", "that colour says for a pixel's side of a hem");
  v("hem_boundary_least_share", p.hem_boundary.least_share, 0.5, 1, "",
    "of the pixels beside a hem that tell their side");
  v("hem_boundary_rounds", p.hem_boundary.rounds, 1, 10, "", "rounds of learning the colours of top and bottom");
}

// Skin, top and bottom in three steps, each joint over the views: evidence of offset and change against the naked
// mannequin; cloth or skin; upper or lower garment.
Segmentation joint_mrf(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                       const ExtractedViews& extracted, const Registration& registration,
                       const JointMrfParams& params) {
  require_known(naked, "segment.joint_mrf");
  const NakedBody body(naked);
  const auto views = gather_views(session, calibration, body, extracted, registration, params.evidence);
  const auto cloth = find_cloth(views, params.cloth);
  TopBottomParams hem_boundary = params.hem_boundary;
  hem_boundary.speck_mm2 = params.cloth.speck_mm2;
  const TopBottom parted = part_cloth(views, cloth, body.limbs, hem_boundary);
  return labelled_views(session, calibration, body, views, parted);
}

const Segment::Variant joint_mrf_variant{"joint_mrf", joint_mrf};

}  // namespace
}  // namespace dressform
