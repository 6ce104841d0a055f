#pragma once
#include <vector>

#include "eval/report/image_tools.h"
#include "pipeline/reconstruct.h"
#include "render/renderer.h"
#include "scenes/ground_truth.h"

namespace dressform {

// Unsigned distance of every vertex to the other surface, millimetres.
std::vector<double> vertex_distances_mm(const Mesh& mesh, const Mesh& truth);

// Heat maps of the distance to the truth with a colour bar, and the garments beside the true ones from where no sensor
// stood. Joined through the first sensor, as the scorer does; empty when that sensor is not registered.
std::vector<Figure> error_figures(const Reconstruction& reconstruction, const GroundTruth& truth, Renderer& renderer);

}  // namespace dressform
