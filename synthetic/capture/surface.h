#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "scenes/label.h"
#include "scenes/mesh.h"

namespace dressform {

struct Material {
  Vector3f albedo_rgb = Vector3f::Constant(0.5f);  // linear; multiplies the texture where there is one
  float nir_albedo = 0.5f;                         // at 860 nm; independent of the visible colour
  float nir_print = 0;                             // how much of the print's light and dark shows in it
  float gloss = 0;                                 // strength of the highlight
  float gloss_exponent = 40;
  bool chrome = false;                       // a mirror: depth cameras see a hole
  Vector3f emission_rgb = Vector3f::Zero();  // linear, of a lamp's own surface
};

// One thing that rays can hit, in the world frame. Seen from both sides.
struct RaySurface {
  std::string name;
  Mesh mesh;
  Material material;
  Label label = Label::none;
  bool smooth = true;                              // interpolated normals; false: facets
  std::vector<std::array<Vector2f, 3>> corner_uv;  // one per triangle, or empty
  cv::Mat texture;                                 // 8-bit BGR sRGB; empty: plain
};

}  // namespace dressform
