#include "pipeline/surface/cloths.h"

#include <utility>

#include "pipeline/garment/garment_ends.h"
#include "pipeline/garment/garment_kind.h"
#include "pipeline/garment/worn_order.h"

namespace dressform {
namespace {

// A cleaned cloud says more of a garment than labelled pixels do: where it ends, and whether there are legs in it,
// unless the pixels were surer of that.
GarmentLayout refined(GarmentLayout layout, const PointCloud& cloud, const MeshQuery& naked, const Landmarks& limbs) {
  if (!layout.upper())
    if (const FoundKind found = bottom_kind(cloud.points, limbs); found.sure > layout.sure_kind)
      layout = with_kind(std::move(layout), found, limbs);
  return with_ends(std::move(layout), cloud.points, naked, limbs);
}

}  // namespace

Cloths gather_cloths(const CaptureSession& session, const FilledViews& filled, const GarmentLayouts& segmented,
                     const std::vector<DepthView>& views, const MeshQuery& naked, const Landmarks& limbs,
                     const GarmentCloudParams& params, int fewest_points) {
  Cloths result;
  for (const auto& [name, layout] : segmented) {
    GarmentCloud cloud = garment_cloud(name, filled, views, session, naked, limbs, params);
    if (static_cast<int>(cloud.cloud.points.size()) < fewest_points) continue;
    result.layouts.emplace(name, refined(layout, cloud.cloud, naked, limbs));
    result.clouds.emplace(name, std::move(cloud));
  }
  if (result.clouds.size() < 2) return result;
  GarmentLayout &top = result.layouts.at("top"), &bottom = result.layouts.at("bottom");
  const WornOrder order = worn_order(result.clouds["top"].cloud, result.clouds["bottom"].cloud, naked, limbs);
  top.worn = order.top;
  bottom.worn = order.top == Worn::under ? Worn::over : Worn::under;
  top.sure_worn = bottom.sure_worn = order.sure;
  if (bottom.worn == Worn::under) bottom = up_to_the_waist(bottom, top, limbs);
  return result;
}

void take_kind_of_surface(const Landmarks& limbs, ClosedGarment& garment) {
  GarmentLayout& layout = garment.layout;
  if (layout.upper()) return;
  const FoundKind before{layout.kind, layout.sure_kind};
  layout = with_kind(std::move(layout), closed_bottom_kind(garment.mesh, limbs, before), limbs);
}

ClosedGarments with_order_settled(ClosedGarments closed) {
  if (closed.garments.size() < 2)
    for (auto& [name, garment] : closed.garments) garment.layout.worn = Worn::alone;
  return closed;
}

}  // namespace dressform
