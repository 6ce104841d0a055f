#pragma once
#include "pipeline/body/body_landmarks.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/surface/covered_body.h"
#include "pipeline/surface/garment_cloud.h"

namespace dressform {

// The cloud with points of little weight beyond its hem, cuffs, ankles or waist, `reach_m` far: cloth goes on as it
// comes, along its own slope, so that folds and flare last up to the rim. (Pixels at rims are dropped, so points end
// short of it, and an ease that is harmonic there would have smoothed the folds away.)
GarmentCloud extrapolated(const GarmentCloud& cloud, const GarmentLayout& layout, const MeshQuery& naked,
                          const Landmarks& limbs, double reach_m);

}  // namespace dressform
