#pragma once
#include <vector>

#include "eval/report/html.h"
#include "eval/report/image_tools.h"
#include "pipeline/reconstruct.h"
#include "render/renderer.h"
#include "scenes/ground_truth.h"

namespace dressform {

// Unsigned distance of every vertex to the other surface, millimetres.
std::vector<double> vertex_distances_mm(const Mesh& mesh, const Mesh& truth);

// Heat maps of the distance to the truth with a colour bar, and the garments beside the true ones from where no sensor
// stood. Joined through the first sensor, as the scorer does; empty when that sensor is not registered.
struct ErrorImages {
  std::vector<Figure> maps;
  std::vector<ImageComparison> beside_truth;
};
ErrorImages error_images(const Reconstruction& reconstruction, const GroundTruth& truth, Renderer& renderer);

// How far two pictures of one size are apart, as CIE76's colour difference in L*a*b*, in the colours of a scale from 0
// to `most`, with its bar. 8-bit BGR.
cv::Mat difference_image(const cv::Mat& made, const cv::Mat& reference, double most);

}  // namespace dressform
