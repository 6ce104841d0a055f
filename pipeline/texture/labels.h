#pragma once
#include <vector>

#include "pipeline/texture/surface_graph.h"
#include "pipeline/texture/vertex_samples.h"

namespace dressform {

struct LabelParams {
  double cutoff_deg = 75;      // surfaces more oblique than this are not taken from a view
  double smoothness_m = 0.02;  // price of a metre of seam, in square metres of the worst view
  double seam_contrast = 4;    // how much dearer a seam is in the busiest print than on plain cloth
};

struct Labels {
  std::vector<int> view;      // per triangle: the view that colours it, -1 where there is no view at all
  std::vector<bool> covered;  // per triangle: that view sees it (or has it filled in) within the cutoff
};

// Which view colours which triangle: the least sum of obliqueness times area and of seams, by alpha expansion
// (Boykov, Veksler and Zabih, PAMI 2001; Lempitsky and Ivanov, CVPR 2007).
Labels label_triangles(const Mesh& mesh, const SurfaceGraph& graph, const VertexSamples& samples,
                       const LabelParams& params);

// Each triangle from the view that sees it best, whatever its neighbours do.
Labels best_view_labels(const Mesh& mesh, const VertexSamples& samples, const LabelParams& params);

// The view towards which the surface lies as seen from the garment's upright axis, visible or not: the mesh cut in
// as many sectors as there are views.
Labels sector_labels(const Mesh& mesh, const std::vector<ColorView>& views, const VertexSamples& samples,
                     const LabelParams& params);

}  // namespace dressform
