#pragma once
#include <map>
#include <string>
#include <vector>

#include "pipeline/surface/garment_cloud.h"
#include "pipeline/surface/surface.h"

namespace dressform {

// Clouds of the garments that enough points show, and what they say of how the garments are worn: ends, kind, order.
struct Cloths {
  std::map<std::string, GarmentCloud> clouds;
  GarmentLayouts layouts;
};
Cloths gather_cloths(const CaptureSession& session, const FilledViews& filled, const GarmentLayouts& segmented,
                     const std::vector<DepthView>& views, const MeshQuery& naked, const Landmarks& limbs,
                     const GarmentCloudParams& params, int fewest_points);

// The kind that a closed surface is, which decides how many openings can be cut.
void take_kind_of_surface(const Landmarks& limbs, ClosedGarment& garment);

// A garment that is left by itself is worn over nothing and under nothing.
ClosedGarments with_order_settled(ClosedGarments closed);

}  // namespace dressform
