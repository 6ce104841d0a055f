#pragma once
#include <string>
#include <vector>

#include "pipeline/garment/garment_layout.h"
#include "pipeline/geometry/mesh_query.h"

namespace dressform {

// The layout with its ends (top_y, bottom_y, arms, legs) told by where points of the garment are, but for a few strays:
// which limbs it goes round, how far, and where sleeve and trunk come apart. `naked`: the body's surface, the mesh that
// `landmarks` are of. Kind and order stay.
GarmentLayout with_ends(GarmentLayout layout, const std::vector<Vector3d>& points, const MeshQuery& naked,
                        const Landmarks& landmarks);

// Trousers and skirts whose upper end a top hides reach up to the body's waist, however long the top is: two legs alone
// would be no garment.
GarmentLayout up_to_the_waist(GarmentLayout bottom, const GarmentLayout& top, const Landmarks& landmarks);

}  // namespace dressform
