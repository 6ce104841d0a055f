#include "scenes/formats/glb_material.h"

#include <algorithm>

namespace dressform {
namespace {

// KHR_texture_transform: offset * rotation * scale, as its specification writes the matrices.
Eigen::Affine2f texture_transform(const tinygltf::Value& extension) {
  const auto number = [](const tinygltf::Value& value) { return static_cast<float>(value.GetNumberAsDouble()); };
  const auto pair = [&](const char* key, float otherwise) {
    Vector2f result(otherwise, otherwise);
    if (!extension.Has(key) || !extension.Get(key).IsArray() || extension.Get(key).ArrayLen() < 2) return result;
    return Vector2f(number(extension.Get(key).Get(0)), number(extension.Get(key).Get(1)));
  };
  const float angle = extension.Has("rotation") ? number(extension.Get("rotation")) : 0.0f;
  Eigen::Matrix2f rotation;
  rotation << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
  Eigen::Affine2f result = Eigen::Affine2f::Identity();
  result.linear() = rotation * pair("scale", 1).asDiagonal();
  result.translation() = pair("offset", 0);
  return result;
}

Wrap wrap_of(int gltf) {
  if (gltf == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  return gltf == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

// The number of a glTF image among `images`.
int image_number(const std::filesystem::path& path, const GlbData& data, int index, std::vector<FileImage>& images) {
  const tinygltf::Image& image = data.at(data.model().images, index, "image");
  FileImage wanted{path, {}};
  if (!image.image.empty())
    wanted.bytes.assign(image.image.begin(), image.image.end());
  else if (!image.uri.empty())
    wanted.file = path.parent_path() / image.uri;
  else
    data.fail("image " + std::to_string(index) + " has no data; expected a PNG or JPEG");
  const auto known = std::find_if(images.begin(), images.end(), [&](const FileImage& other) {
    return other.file == wanted.file && other.bytes == wanted.bytes;
  });
  const auto number = known - images.begin();
  if (known == images.end()) images.push_back(std::move(wanted));
  return static_cast<int>(number);
}

void read_texture(const std::filesystem::path& path, const GlbData& data, const tinygltf::TextureInfo& info,
                  std::vector<FileImage>& images, GlbMaterial& result) {
  const tinygltf::Texture& texture = data.at(data.model().textures, info.index, "texture");
  if (texture.source < 0) {
    const std::string extension = texture.extensions.empty() ? "" : texture.extensions.begin()->first;
    result.material.fault.emplace(path.string(), "texture " + std::to_string(info.index) + " has no image" +
                                                     (extension.empty() ? "" : " but by the extension " + extension) +
                                                     "; expected a PNG or JPEG");
    return;
  }
  result.material.image = image_number(path, data, texture.source, images);
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = data.at(data.model().samplers, texture.sampler, "sampler");
    result.material.wrap = {wrap_of(sampler.wrapS), wrap_of(sampler.wrapT)};
  }
  result.uv_set = info.texCoord;
  const auto moved = info.extensions.find("KHR_texture_transform");
  if (moved == info.extensions.end()) return;
  result.image_from_uv = texture_transform(moved->second);
  if (moved->second.Has("texCoord")) result.uv_set = moved->second.Get("texCoord").GetNumberAsInt();
}

void read_transparency(const tinygltf::Material& material, double alpha_factor, FileMaterial& result) {
  result.opacity = alpha_factor;
  if (material.alphaMode == "MASK") {
    result.transparency = Transparency::holes;
    result.cutoff = material.alphaCutoff;
  } else if (material.alphaMode == "BLEND") {
    result.transparency = Transparency::blended;
  }
  result.opacity_image = result.transparency == Transparency::ignored ? -1 : result.image;
}

}  // namespace

GlbMaterial read_glb_material(const std::filesystem::path& path, const GlbData& data, int index,
                              std::vector<FileImage>& images) {
  const tinygltf::Material& material = data.at(data.model().materials, index, "material");
  const auto& surface = material.pbrMetallicRoughness;
  GlbMaterial result;
  result.material.name = material.name.empty() ? "material " + std::to_string(index) : material.name;
  result.material.tint_is_linear = true;
  const auto& factor = surface.baseColorFactor;
  if (factor.size() == 4)
    for (int k = 0; k < 3; ++k) result.material.tint[k] = static_cast<float>(std::clamp(factor[k], 0.0, 1.0));
  if (surface.baseColorTexture.index >= 0) read_texture(path, data, surface.baseColorTexture, images, result);
  read_transparency(material, factor.size() == 4 ? factor[3] : 1.0, result.material);
  for (const char* name : {"KHR_materials_pbrSpecularGlossiness", "KHR_materials_transmission"})
    if (material.extensions.count(name))
      result.material.fault.emplace(path.string(), "material \"" + result.material.name + "\" uses " + name +
                                                       "; expected base colour and its texture (metallic-roughness)");
  return result;
}

}  // namespace dressform
