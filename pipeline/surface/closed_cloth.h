#pragma once
#include <functional>
#include <string>
#include <vector>

#include "pipeline/geometry/lattice.h"
#include "pipeline/surface/cloths.h"
#include "pipeline/surface/covered_body.h"

namespace dressform {

// What the variants share that make a garment's surface by a general method, which knows nothing of bodies.

// Points as measured, outliers out: what a person would hand to a general method.
GarmentCloudParams as_measured();

// The points with normals by principal components of their nearest neighbours, each towards the sensor that saw it.
PointCloud oriented(PointCloud cloud, const std::vector<DepthView>& views, int neighbours);

// Takes out of the field (m, negative inside) what a view looks through, by more than `see_through_m`, between the
// garment's ends. Whether it did.
bool carved(const Lattice& lattice, const std::vector<DepthView>& views, const CoveredBody& body, double see_through_m,
            std::vector<float>& field);

// A garment on its way from points to a surface.
struct ClothTask {
  std::string name;           // "top", "bottom"
  const PointCloud& support;  // oriented
  const std::vector<DepthView>& views;
  const CoveredBody& body;
};

// The closed surface of a field (m, negative inside) in which the views have carved: one piece without handles. Empty
// where nothing is inside.
Mesh closed_level_set(const ClothTask& task, const Lattice& lattice, std::vector<float> field, double see_through_m);

// The closed surface of a sheet that need not be closed, manifold or one piece, triangles outward: its inside is where
// it goes round by more than half (geometry/winding_number.h). Where the sheet is, so is the surface.
Mesh closed_sheet(const ClothTask& task, const Mesh& sheet, double step_m, double see_through_m);

// All garments that enough points show, each by `make`; those without a surface are left out. `variant` names it for
// errors. Throws as the stage does.
ClosedGarments closed_cloths(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                             const Registration& registration, const FilledViews& filled,
                             const GarmentLayouts& segmented, const GarmentCloudParams& cloud, int normal_neighbours,
                             int fewest_points, const std::string& variant,
                             const std::function<Mesh(const ClothTask&)>& make);

}  // namespace dressform
