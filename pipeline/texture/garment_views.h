#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pipeline/texture/gains.h"
#include "pipeline/texture/labels.h"
#include "pipeline/texture/paint.h"

namespace dressform {

// A garment and what the views say of it: what all variants of the stage start from.
struct GarmentViews {
  const Mesh* mesh = nullptr;
  std::vector<ColorView> views;
  VertexSamples samples;
  Eigen::MatrixXf unlit;  // vertices x 3: factors in linear light that take the light off; none when empty
};

std::map<std::string, GarmentViews> garment_views(const CaptureSession& session, const Calibration& calibration,
                                                  const BodyModel& naked, const Registration& registration,
                                                  const FilledViews& filled, const OpenGarments& opened,
                                                  const ViewParams& params);

// The same with the exposures of the views made equal, over all garments at once.
std::map<std::string, GarmentViews> levelled_exposure(std::map<std::string, GarmentViews> garments,
                                                      const GainParams& gain, const ViewParams& params);

// How far over the surface the choice of a view is blurred, for coarse colour and fine detail.
struct BlendParams {
  double coarse_m = 0, fine_m = 0;
};

// All garments coloured from the views that `choose` picks for their triangles.
using ChooseViews = std::function<Labels(const GarmentViews&, const SurfaceGraph&)>;
TexturedGarments textured(const std::map<std::string, GarmentViews>& garments, const ChooseViews& choose,
                          const BlendParams& blend, const AtlasParams& atlas, const ViewParams& params);

}  // namespace dressform
