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
using Texture = Stage<TextureTag, TexturedGarments(const CaptureSession&, const Calibration&, const BodyModel& naked,
                                                   const Registration&, const FilledViews&, const OpenGarments&)>;

}  // namespace dressform
