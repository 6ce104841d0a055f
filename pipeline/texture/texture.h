#pragma once
#include <map>
#include <string>

#include "pipeline/fill/fill.h"
#include "pipeline/open/open.h"
#include "pipeline/run/stage.h"

namespace dressform {

struct TexturedGarments {
  std::map<std::string, TexturedMesh> garments;  // "top", "bottom"; vertices and triangles as in OpenGarments
  std::map<std::string, double> unseen_part;     // part of the area that no view gave a colour

  template <class Archive>
  void serialize(Archive& archive) {
    archive(garments, unseen_part);
  }
};

struct TextureTag {
  static constexpr const char* name = "texture";
  static constexpr const char* default_variant = "levelled";
};

// The opened garments with one texture each, from the colours of all views.
//
// In: raw colour images (8-bit BGR, sRGB) and filled ones, cameras, poses, the naked body, which hides and casts, and
// the garments' meshes in the model frame, metres.
// Out: the same meshes, vertex for vertex, with corner_uv (u right, v down, 0 to 1) and an 8-bit BGR texture; charts do
// not overlap, but where a variant takes photographs as they are and its header says so. What no view saw takes its
// colour from the surface about it; a garment that nobody saw is grey, and unseen_part 1. Throws nothing of its own: a
// view without pose, colour or mask is left out. Lempitsky and Ivanov, "Seamless mosaicing of image-based texture
// maps", CVPR 2007; Waechter, Moehrle and Goesele, "Let there be color!", ECCV 2014.
using Texture = Stage<TextureTag, TexturedGarments(const CaptureSession&, const Calibration&, const BodyModel& naked,
                                                   const Registration&, const FilledViews&, const OpenGarments&)>;

}  // namespace dressform
