#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/formats/file_mesh.h"

namespace dressform {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

// Images are kept as they are in the file; whoever needs one decodes it.
bool keep_encoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                  int size, void*) {
  image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

class Reader {
 public:
  Reader(std::string where, std::filesystem::path folder, const tinygltf::Model& model)
      : where_(std::move(where)), folder_(std::move(folder)), model_(model) {}

  FileMesh read() {
    for (int node : roots()) read_node(node, Eigen::Matrix4d::Identity(), 0);
    result_.may_be_split = true;
    for (int image : images_) read_image(image);
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(where_, problem); }

  template <class T>
  const T& at(const std::vector<T>& list, int index, const char* what) const {
    if (index < 0 || index >= static_cast<int>(list.size()))
      fail(std::string("names ") + what + " " + std::to_string(index) + "; expected one that the file has");
    return list[index];
  }

  std::vector<int> roots() const {
    if (!model_.scenes.empty()) return at(model_.scenes, std::max(0, model_.defaultScene), "scene").nodes;
    std::vector<char> is_child(model_.nodes.size(), 0);
    for (const auto& node : model_.nodes)
      for (int child : node.children)
        if (child >= 0 && child < static_cast<int>(is_child.size())) is_child[child] = 1;
    std::vector<int> result;
    for (int n = 0; n < static_cast<int>(is_child.size()); ++n)
      if (!is_child[n]) result.push_back(n);
    return result;
  }

  static Eigen::Matrix4d local_transform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());  // both column-major
    Eigen::Affine3d motion = Eigen::Affine3d::Identity();
    if (node.translation.size() == 3) motion.translate(Eigen::Map<const Vector3d>(node.translation.data()));
    if (node.rotation.size() == 4) {
      const auto& q = node.rotation;  // x, y, z, w
      motion.rotate(Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized());
    }
    if (node.scale.size() == 3) motion.scale(Eigen::Map<const Vector3d>(node.scale.data()));
    return motion.matrix();
  }

  void read_node(int index, const Eigen::Matrix4d& world_from_parent, int depth) {
    if (depth > 64) fail("the nodes form a cycle or are nested more than 64 deep");
    const tinygltf::Node& node = at(model_.nodes, index, "node");
    const Eigen::Matrix4d world_from_node = world_from_parent * local_transform(node);
    if (node.mesh >= 0)
      for (const auto& primitive : at(model_.meshes, node.mesh, "mesh").primitives)
        read_primitive(primitive, world_from_node);
    for (int child : node.children) read_node(child, world_from_node, depth + 1);
  }

  // The accessor's first component of each element, with the step between elements; bounds are checked.
  struct Data {
    const unsigned char* bytes;
    std::size_t stride, count;
    int component_type;
    double scale;  // of normalised whole numbers
  };
  Data data_of(int index, int wanted_type) const {
    const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
    if (accessor.type != wanted_type || accessor.sparse.isSparse)
      fail("accessor " + std::to_string(index) + " is sparse or of another type; expected plain data");
    const tinygltf::BufferView& view = at(model_.bufferViews, accessor.bufferView, "buffer view");
    const tinygltf::Buffer& buffer = at(model_.buffers, view.buffer, "buffer");
    const int stride = accessor.ByteStride(view);
    const std::size_t element =
        tinygltf::GetComponentSizeInBytes(accessor.componentType) * tinygltf::GetNumComponentsInType(accessor.type);
    if (stride <= 0) fail("accessor " + std::to_string(index) + " has no valid step");
    const std::size_t size = buffer.data.size(), start = view.byteOffset + accessor.byteOffset;
    const bool inside = view.byteOffset <= size && accessor.byteOffset <= size && start + element <= size &&
                        (accessor.count == 0 || accessor.count - 1 <= (size - start - element) / stride);
    if (!inside) fail("accessor " + std::to_string(index) + " leaves its buffer; the file is truncated or damaged");
    double scale = 1;
    if (accessor.normalized) scale = element_scale(accessor.componentType);
    return {buffer.data.data() + start, static_cast<std::size_t>(stride), accessor.count, accessor.componentType,
            scale};
  }

  static double element_scale(int component_type) {
    switch (component_type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return 1.0 / 127;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1.0 / 255;
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return 1.0 / 32767;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 1.0 / 65535;
      default:
        return 1;
    }
  }

  template <class T>
  static double value_at(const unsigned char* bytes, int component) {
    T value;
    std::memcpy(&value, bytes + component * sizeof(T), sizeof(T));
    return static_cast<double>(value);
  }

  double number(const Data& data, std::size_t element, int component) const {
    const unsigned char* bytes = data.bytes + element * data.stride;
    switch (data.component_type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return data.scale * value_at<std::int8_t>(bytes, component);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return data.scale * value_at<std::uint8_t>(bytes, component);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return data.scale * value_at<std::int16_t>(bytes, component);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return data.scale * value_at<std::uint16_t>(bytes, component);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return value_at<std::uint32_t>(bytes, component);
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return value_at<float>(bytes, component);
    }
    fail("found an unknown component type; expected one of glTF's");
  }

  // Vertex numbers (within the primitive) of its triangles, three in a row.
  std::vector<std::size_t> corner_numbers(const tinygltf::Primitive& primitive, std::size_t vertices) const {
    std::vector<std::size_t> list;
    if (primitive.indices >= 0) {
      const Data data = data_of(primitive.indices, TINYGLTF_TYPE_SCALAR);
      for (std::size_t i = 0; i < data.count; ++i) list.push_back(static_cast<std::size_t>(number(data, i, 0)));
    } else {
      for (std::size_t i = 0; i < vertices; ++i) list.push_back(i);
    }
    for (std::size_t index : list)
      if (index >= vertices) fail("a triangle names vertex " + std::to_string(index) + "; expected one that exists");
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode < 0) return list;
    std::vector<std::size_t> result;
    const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    for (std::size_t i = 2; i < list.size(); ++i) {
      const bool swapped = !fan && i % 2 == 1;
      const std::size_t a = fan ? list[0] : list[i - 2];
      result.insert(result.end(), {a, swapped ? list[i] : list[i - 1], swapped ? list[i - 1] : list[i]});
    }
    return result;
  }

  void read_primitive(const tinygltf::Primitive& primitive, const Eigen::Matrix4d& world_from_node) {
    if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES) return;  // points and lines
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) fail("a primitive has no POSITION; expected one");
    const Data xyz = data_of(position->second, TINYGLTF_TYPE_VEC3);
    const int first = static_cast<int>(result_.mesh.vertices.size());
    for (std::size_t i = 0; i < xyz.count; ++i) {
      const Vector3d local(number(xyz, i, 0), number(xyz, i, 1), number(xyz, i, 2));
      result_.mesh.vertices.push_back((world_from_node * local.homogeneous()).head<3>());
    }
    const std::vector<Vector2f> uv = read_uv(primitive, xyz.count);
    const bool mirrored = world_from_node.topLeftCorner<3, 3>().determinant() < 0;
    const auto corners = corner_numbers(primitive, xyz.count);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      const std::size_t a = corners[i], b = corners[i + (mirrored ? 2 : 1)], c = corners[i + (mirrored ? 1 : 2)];
      result_.mesh.triangles.emplace_back(first + static_cast<int>(a), first + static_cast<int>(b),
                                          first + static_cast<int>(c));
      result_.corner_uv.push_back({uv[a], uv[b], uv[c]});
    }
  }

  // Texture coordinates that the material's image wants; remembers the image.
  std::vector<Vector2f> read_uv(const tinygltf::Primitive& primitive, std::size_t vertices) {
    int set = 0;
    if (primitive.material >= 0) {
      const auto& info = at(model_.materials, primitive.material, "material").pbrMetallicRoughness.baseColorTexture;
      if (info.extensions.count("KHR_texture_transform"))
        fail("uses KHR_texture_transform; expected texture coordinates without it");
      set = info.texCoord;
      if (info.index >= 0) images_.insert(at(model_.textures, info.index, "texture").source);
    }
    std::vector<Vector2f> uv(vertices, Vector2f(kNone, kNone));
    const auto found = primitive.attributes.find("TEXCOORD_" + std::to_string(set));
    if (found == primitive.attributes.end()) return uv;
    const Data data = data_of(found->second, TINYGLTF_TYPE_VEC2);
    if (data.count != vertices) fail("TEXCOORD and POSITION differ in number");
    for (std::size_t i = 0; i < vertices; ++i)
      uv[i] = Vector2f(static_cast<float>(number(data, i, 0)), static_cast<float>(number(data, i, 1)));
    return uv;
  }

  void read_image(int index) {
    const tinygltf::Image& image = at(model_.images, index, "image");
    if (!image.image.empty())
      result_.embedded_images.emplace_back(image.image.begin(), image.image.end());
    else if (!image.uri.empty())
      result_.images.push_back(folder_ / image.uri);
  }

  std::string where_;
  std::filesystem::path folder_;
  const tinygltf::Model& model_;
  FileMesh result_;
  std::set<int> images_;
};

}  // namespace

FileMesh read_glb_mesh(const std::filesystem::path& path) {
  const std::string where = path.string(), bytes = read_file_bytes(path);
  if (bytes.size() < 20) throw InputError(where, "the file is too short; expected a GLB");
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_encoded, nullptr);
  tinygltf::Model model;
  std::string errors, warnings;
  bool good = false;
  try {
    good = loader.LoadBinaryFromMemory(&model, &errors, &warnings, reinterpret_cast<const unsigned char*>(bytes.data()),
                                       static_cast<unsigned>(bytes.size()), path.parent_path().string());
  } catch (const std::exception& error) {
    errors = error.what();
  }
  if (!good) throw InputError(where, "not a readable GLB: " + errors.substr(0, errors.find('\n')));
  return Reader(where, path.parent_path(), model).read();
}

}  // namespace dressform
