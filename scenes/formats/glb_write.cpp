#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

#include "scenes/file_bytes.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

// The mesh as glTF wants it: one vertex for each pair of a place and a texture coordinate.
struct SplitMesh {
  std::vector<Vector3f> positions, normals;
  std::vector<Vector2f> uv;
  std::vector<std::uint32_t> indices;
};

SplitMesh split_at_seams(const TexturedMesh& textured) {
  SplitMesh result;
  const std::vector<Vector3d> normals = vertex_normals(textured.mesh);
  std::vector<std::vector<std::uint32_t>> copies(textured.mesh.vertices.size());
  for (std::size_t i = 0; i < textured.mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int vertex = textured.mesh.triangles[i][k];
      const Vector2f& uv = textured.corner_uv[i][k];
      auto& known = copies[vertex];
      auto copy = std::find_if(known.begin(), known.end(), [&](std::uint32_t c) { return result.uv[c] == uv; });
      if (copy == known.end()) {
        copy = known.insert(known.end(), static_cast<std::uint32_t>(result.uv.size()));
        result.positions.push_back(textured.mesh.vertices[vertex].cast<float>());
        result.normals.push_back(normals[vertex].cast<float>());
        result.uv.push_back(uv);
      }
      result.indices.push_back(*copy);
    }
  return result;
}

class Builder {
 public:
  Builder() {
    model_.buffers.emplace_back();
    model_.asset.version = "2.0";
    model_.asset.generator = "dressform " DRESSFORM_VERSION;
  }

  int add_view(const void* data, std::size_t size, int target) {
    auto& bytes = model_.buffers[0].data;
    bytes.resize((bytes.size() + 3) / 4 * 4, 0);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = size;
    view.target = target;
    const auto* begin = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  template <class T>
  int add_accessor(const std::vector<T>& values, int component_type, int type, int target) {
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(values.data(), values.size() * sizeof(T), target);
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = values.size();
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  void add_mesh(const SplitMesh& mesh) {
    tinygltf::Primitive primitive;
    const int floats = TINYGLTF_COMPONENT_TYPE_FLOAT, array = TINYGLTF_TARGET_ARRAY_BUFFER;
    primitive.attributes["POSITION"] = add_accessor(mesh.positions, floats, TINYGLTF_TYPE_VEC3, array);
    set_bounds(model_.accessors.back(), mesh.positions);
    primitive.attributes["NORMAL"] = add_accessor(mesh.normals, floats, TINYGLTF_TYPE_VEC3, array);
    primitive.attributes["TEXCOORD_0"] = add_accessor(mesh.uv, floats, TINYGLTF_TYPE_VEC2, array);
    primitive.indices = add_accessor(mesh.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                     TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    tinygltf::Mesh gltf_mesh;
    gltf_mesh.primitives.push_back(primitive);
    model_.meshes.push_back(gltf_mesh);
    tinygltf::Node node;
    node.mesh = 0;
    model_.nodes.push_back(node);
    tinygltf::Scene scene;
    scene.nodes.push_back(0);
    model_.scenes.push_back(scene);
    model_.defaultScene = 0;
  }

  void add_cloth(const std::vector<std::uint8_t>& png, bool repeats) {
    tinygltf::Image image;
    image.bufferView = add_view(png.data(), png.size(), 0);
    image.mimeType = "image/png";
    model_.images.push_back(image);
    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = sampler.wrapT = repeats ? TINYGLTF_TEXTURE_WRAP_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model_.samplers.push_back(sampler);
    tinygltf::Texture texture;
    texture.source = texture.sampler = 0;
    model_.textures.push_back(texture);
    tinygltf::Material material;
    material.name = "cloth";
    material.doubleSided = true;
    material.pbrMetallicRoughness.baseColorTexture.index = 0;
    material.pbrMetallicRoughness.metallicFactor = 0;
    model_.materials.push_back(material);
  }

  const tinygltf::Model& model() const { return model_; }

 private:
  static void set_bounds(tinygltf::Accessor& accessor, const std::vector<Vector3f>& positions) {
    Vector3f low = positions.at(0), high = low;
    for (const auto& p : positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    accessor.minValues.assign(low.data(), low.data() + 3);
    accessor.maxValues.assign(high.data(), high.data() + 3);
  }

  tinygltf::Model model_;
};

}  // namespace

void write_glb(const std::filesystem::path& path, const TexturedMesh& textured) {
  if (textured.mesh.triangles.empty() || textured.corner_uv.size() != textured.mesh.triangles.size())
    throw std::invalid_argument("write_glb: triangles, each with texture coordinates");
  if (textured.texture.empty() || textured.texture.type() != CV_8UC3)
    throw std::invalid_argument("write_glb: texture is 8-bit BGR");
  std::vector<std::uint8_t> png;
  cv::imencode(".png", textured.texture, png);
  const SplitMesh split = split_at_seams(textured);
  const bool repeats = std::any_of(split.uv.begin(), split.uv.end(), [](const Vector2f& uv) {
    return uv.minCoeff() < -1e-4f || uv.maxCoeff() > 1 + 1e-4f;
  });
  Builder builder;
  builder.add_mesh(split);
  builder.add_cloth(png, repeats);
  std::ostringstream stream;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&builder.model(), stream, false, true))
    throw std::runtime_error("write_glb: the glTF library cannot write this model");
  write_file_atomically(path, stream.str());
}

}  // namespace dressform
