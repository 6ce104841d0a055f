#pragma once
#include <string>
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/fill/fill.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/imaging/depth_view.h"
#include "scenes/capture_session.h"

namespace dressform {

struct GarmentCloudParams {
  double smooth_px = 1.2;        // sigma of the plane fit in the depth image; 0: depth as it is
  double usual_noise_mm = 2.0;   // of depth for which smooth_px is meant
  double jump_mm = 25;           // neighbouring depth pixels that differ by more are an edge
  double mixed_mm = 6;           // pixels at the end of the cloth that are off its plane by more are dropped
  double least_cosine = 0.25;    // surface seen at a lower n.v is dropped
  double see_through_m = 0.03;   // a point this far in front of what another view sees is dropped
  double inside_body_m = 0.012;  // deepest point under the naked surface
  double outside_body_m = 0.15;  // farthest point off the naked surface, above the crotch
  double outside_legs_m = 0.40;  // the same below the crotch, where skirts stand off
  double off_skin_m = 0.003;     // depth without colour counts as cloth this far off the naked legs
  int neighbours = 20;           // of the statistical test
  double outlier_sigma = 3.0;    // mean neighbour distances beyond this are dropped
};

template <class V>
void fields(V& v, GarmentCloudParams& p) {
  v("smooth_px", p.smooth_px, 0.0, 4.0, "px", "sigma of the local plane fit that takes the noise off the depth");
  v("usual_noise_mm", p.usual_noise_mm, 0.1, 100.0, "mm",
    "noise of depth up to which smooth_px and kernel_m hold; above it both grow with its root");
  v("jump_mm", p.jump_mm, 5.0, 100.0, "mm", "neighbouring depth pixels that differ by more are an edge");
  v("mixed_mm", p.mixed_mm, 1.0, 100.0, "mm", "pixels at the end of the cloth this far off its plane are dropped");
  v("least_cosine", p.least_cosine, 0.05, 0.9, "", "surface seen at a lower cosine to its normal is dropped");
  v("see_through_m", p.see_through_m, 0.01, 0.2, "m", "a point this far in front of what another view sees is dropped");
  v("inside_body_m", p.inside_body_m, 0.0, 0.1, "m", "deepest point kept under the naked surface");
  v("outside_body_m", p.outside_body_m, 0.02, 1.0, "m", "farthest point kept off the naked surface above the crotch");
  v("outside_legs_m", p.outside_legs_m, 0.02, 1.0, "m", "farthest point kept off the naked surface below the crotch");
  v("off_skin_m", p.off_skin_m, 0.0, 0.05, "m", "depth that has no colour counts as cloth this far off the naked legs");
  v("neighbours", p.neighbours, 4, 100, "", "nearest neighbours of the statistical outlier test");
  v("outlier_sigma", p.outlier_sigma, 0.5, 10.0, "", "neighbour distances this many deviations out are dropped");
}

// Points of one garment from all views.
struct GarmentCloud {
  PointCloud cloud;            // model frame, normals towards the sensors, sRGB colours, views = index of the sensor
  std::vector<float> weights;  // how far each point is to be believed, 0-1: facing and not made up
  int dropped = 0;             // points the outlier tests took away
  double noise_mm = 0;         // of the garment's depth, all views; 0: too little to tell
  double smoothing = 1;        // by which lengths to average over are multiplied: noisy depth needs longer ones
};

// Oriented, coloured, cleaned points of a garment ("top", "bottom"): depth smoothed by local plane fits; without edges
// of the depth image, grazing surface, points that other views see through, points far from the naked body, and
// statistical outliers. Views that are not registered are left out. May be empty. A bottom goes on where the colour
// camera's image ends (the Kinect's depth reaches lower): into depth that joins it and stands off the naked legs.
GarmentCloud garment_cloud(const std::string& garment, const FilledViews& filled, const std::vector<DepthView>& views,
                           const CaptureSession& session, const MeshQuery& naked, const Landmarks& limbs,
                           const GarmentCloudParams& params);

}  // namespace dressform
