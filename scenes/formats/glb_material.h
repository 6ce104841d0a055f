#pragma once
#include <string>

#include "scenes/formats/file_mesh.h"
#include "scenes/formats/glb_data.h"

namespace dressform {

// A glTF material's colour, and which texture coordinates it wants, moved how.
struct GlbMaterial {
  FileMaterial material;
  int uv_set = 0;
  Eigen::Affine2f image_from_uv = Eigen::Affine2f::Identity();  // KHR_texture_transform
};

// Material `index` of the file. Adds the image it names to `images`.
GlbMaterial read_glb_material(const std::filesystem::path& path, const GlbData& data, int index,
                              std::vector<FileImage>& images);

}  // namespace dressform
