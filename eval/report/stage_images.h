#pragma once
#include <string>
#include <vector>

#include "eval/report/image_tools.h"
#include "pipeline/reconstruct.h"
#include "render/renderer.h"

namespace dressform {

// Images of every stage, as in the thesis's figures 3.x, in the order of the pipeline. All meshes are turned so that
// the first sensor looks at their front.
struct StageFigures {
  std::string label;  // "capture", or a StageRecord's label
  std::vector<Figure> figures;
};
std::vector<StageFigures> stage_figures(const Reconstruction& reconstruction, const CaptureSession& session,
                                        Renderer& renderer);

// Of bodies in all images, RGB.
inline const Eigen::Vector3f kBodyColor{0.86f, 0.80f, 0.74f};

// The finished clothes: on the mannequin and on the user, front, left, back, right; and, unless they are left out, a
// turntable of each. Titles name the garments that were made.
std::vector<Figure> result_figures(const Reconstruction& reconstruction, Renderer& renderer, bool turntables = true);

}  // namespace dressform
