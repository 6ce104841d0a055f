#include <tiny_gltf.h>

#include <limits>
#include <map>
#include <optional>

#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/formats/file_mesh.h"
#include "scenes/formats/glb_data.h"
#include "scenes/formats/glb_material.h"
#include "scenes/formats/glb_nodes.h"
#include "scenes/srgb.h"

namespace dressform {
namespace {

using Eigen::Matrix4d;

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
  Reader(const std::filesystem::path& path, const tinygltf::Model& model, Wanted wanted)
      : path_(path),
        model_(model),
        data_(path.string(), model),
        wanted_(wanted),
        world_from_node_(placed_nodes(model, data_)) {}

  FileMesh read() {
    for (int n = 0; n < static_cast<int>(model_.nodes.size()); ++n)
      if (world_from_node_[n] && model_.nodes[n].mesh >= 0) read_node(n);
    result_.may_be_split = true;
    if (!any_uv_) result_.corner_uv.clear();
    if (!any_color_) result_.corner_color.clear();
    return std::move(result_);
  }

 private:
  void read_node(int index) {
    const tinygltf::Node& node = model_.nodes[index];
    const tinygltf::Mesh& mesh = data_.at(model_.meshes, node.mesh, "mesh");
    for (const auto& primitive : mesh.primitives) {
      if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES) continue;  // points and lines
      read_primitive(primitive, index, node.weights.empty() ? mesh.weights : node.weights);
    }
  }

  // Vertex numbers (within the primitive) of its triangles, three in a row.
  std::vector<int> corner_numbers(const tinygltf::Primitive& primitive, std::size_t vertices) const {
    std::vector<int> list;
    if (primitive.indices >= 0) {
      const std::vector<double> numbers = data_.numbers(primitive.indices, TINYGLTF_TYPE_SCALAR);
      list.reserve(numbers.size());
      for (double index : numbers) {
        if (!(index >= 0 && index < static_cast<double>(vertices)))
          data_.fail("a triangle names vertex " + std::to_string(index) + "; expected one of " +
                     std::to_string(vertices));
        list.push_back(static_cast<int>(index));
      }
    } else {
      for (std::size_t i = 0; i < vertices; ++i) list.push_back(static_cast<int>(i));
    }
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode < 0) return list;
    std::vector<int> result;
    const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    for (std::size_t i = 2; i < list.size(); ++i) {
      const bool swapped = !fan && i % 2 == 1;
      const int a = fan ? list[0] : list[i - 2];
      result.insert(result.end(), {a, swapped ? list[i] : list[i - 1], swapped ? list[i - 1] : list[i]});
    }
    return result;
  }

  // A vertex attribute, of `vertices` elements; empty where the primitive has none.
  std::vector<double> attribute(const std::map<std::string, int>& attributes, const std::string& name, int type,
                                std::size_t vertices) const {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return {};
    if (data_.count(found->second) != vertices) data_.fail(name + " and POSITION differ in number");
    return data_.numbers(found->second, type);
  }

  std::vector<Vector3d> morphed_positions(const tinygltf::Primitive& primitive,
                                          const std::vector<double>& weights) const {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) data_.fail("a primitive has no POSITION; expected one");
    std::vector<double> xyz = data_.numbers(position->second, TINYGLTF_TYPE_VEC3);
    for (std::size_t t = 0; t < primitive.targets.size() && t < weights.size(); ++t) {
      if (weights[t] == 0) continue;
      const std::vector<double> step = attribute(primitive.targets[t], "POSITION", TINYGLTF_TYPE_VEC3, xyz.size() / 3);
      for (std::size_t i = 0; i < step.size(); ++i) xyz[i] += weights[t] * step[i];
    }
    std::vector<Vector3d> result;
    result.reserve(xyz.size() / 3);
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) result.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
    return result;
  }

  // Where each joint takes what is bound to it.
  std::vector<Matrix4d> joint_motions(const tinygltf::Skin& skin) const {
    std::vector<double> inverse;
    if (skin.inverseBindMatrices >= 0) {
      inverse = data_.numbers(skin.inverseBindMatrices, TINYGLTF_TYPE_MAT4);
      if (inverse.size() < 16 * skin.joints.size())
        data_.fail("a skin has fewer inverse bind matrices than its " + std::to_string(skin.joints.size()) + " joints");
    }
    std::vector<Matrix4d> motions;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      const int joint = skin.joints[j];
      data_.at(model_.nodes, joint, "joint");
      if (!world_from_node_[joint]) data_.fail("joint " + std::to_string(joint) + " of a skin is not in the scene");
      motions.push_back(*world_from_node_[joint]);
      if (!inverse.empty()) motions.back() *= Eigen::Map<const Matrix4d>(inverse.data() + 16 * j);
    }
    return motions;
  }

  // Linear blend skinning, as glTF has it: a skinned mesh goes where its joints are, whatever its own node says. Where
  // each vertex's weights take it; empty for a mesh without skin.
  std::vector<Matrix4d> skin_motions(const tinygltf::Primitive& primitive, const tinygltf::Node& node,
                                     std::size_t vertices) const {
    if (node.skin < 0) return {};
    const std::vector<Matrix4d> motions = joint_motions(data_.at(model_.skins, node.skin, "skin"));
    std::vector<Matrix4d> blended(vertices, Matrix4d::Zero());
    std::vector<double> sums(vertices, 0);
    for (int set = 0; primitive.attributes.count("JOINTS_" + std::to_string(set)); ++set) {
      const auto joints =
          attribute(primitive.attributes, "JOINTS_" + std::to_string(set), TINYGLTF_TYPE_VEC4, vertices);
      const auto weights =
          attribute(primitive.attributes, "WEIGHTS_" + std::to_string(set), TINYGLTF_TYPE_VEC4, vertices);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] == 0) continue;
        if (!(joints[i] >= 0 && joints[i] < static_cast<double>(motions.size())))
          data_.fail("a vertex is bound to joint " + std::to_string(joints[i]) + "; expected one of the skin's " +
                     std::to_string(motions.size()));
        blended[i / 4] += weights[i] * motions[static_cast<std::size_t>(joints[i])];
        sums[i / 4] += weights[i];
      }
    }
    for (std::size_t v = 0; v < vertices; ++v) {
      if (!(sums[v] > 0)) data_.fail("vertex " + std::to_string(v) + " of a skinned mesh is bound to no joint");
      blended[v] /= sums[v];
    }
    return blended;
  }

  void read_primitive(const tinygltf::Primitive& primitive, int node, const std::vector<double>& weights) {
    const std::vector<Vector3d> local = morphed_positions(primitive, weights);
    if (result_.mesh.vertices.size() + local.size() > kMostVertices)
      data_.fail("has more than " + std::to_string(kMostVertices) + " vertices; expected a garment or a body");
    const std::vector<Matrix4d> skinned = skin_motions(primitive, model_.nodes[node], local.size());
    const int first = static_cast<int>(result_.mesh.vertices.size());
    for (std::size_t i = 0; i < local.size(); ++i)
      result_.mesh.vertices.push_back(
          ((skinned.empty() ? *world_from_node_[node] : skinned[i]) * local[i].homogeneous()).head<3>());
    const Matrix4d& motion = skinned.empty() ? *world_from_node_[node] : skinned.front();
    add_triangles(primitive, first, local.size(), motion.topLeftCorner<3, 3>().determinant() < 0);
  }

  void add_triangles(const tinygltf::Primitive& primitive, int first, std::size_t vertices, bool mirrored) {
    const int material = wanted_ == Wanted::look ? material_number(primitive) : -1;
    const auto uv = read_uv(primitive, material, vertices);
    const auto colors = read_colors(primitive, material, vertices);
    const auto corners = corner_numbers(primitive, vertices);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      const int a = corners[i], b = corners[i + (mirrored ? 2 : 1)], c = corners[i + (mirrored ? 1 : 2)];
      result_.mesh.triangles.emplace_back(first + a, first + b, first + c);
      if (wanted_ == Wanted::shape) continue;
      result_.material.push_back(material);
      result_.corner_uv.push_back({uv[a], uv[b], uv[c]});
      result_.corner_color.push_back({colors[a], colors[b], colors[c]});
    }
  }

  // The number of the primitive's material in the result; -1 without one.
  int material_number(const tinygltf::Primitive& primitive) {
    if (primitive.material < 0) return -1;
    const auto [at, fresh] = numbers_.try_emplace(primitive.material, static_cast<int>(glb_materials_.size()));
    if (fresh) {
      glb_materials_.push_back(read_glb_material(path_, data_, primitive.material, result_.images));
      result_.materials.push_back(glb_materials_.back().material);
    }
    return at->second;
  }

  std::vector<Vector2f> read_uv(const tinygltf::Primitive& primitive, int material, std::size_t vertices) {
    if (wanted_ == Wanted::shape) return {};
    std::vector<Vector2f> uv(vertices, Vector2f(kNone, kNone));
    const GlbMaterial look = material < 0 ? GlbMaterial{} : glb_materials_[material];
    const auto numbers =
        attribute(primitive.attributes, "TEXCOORD_" + std::to_string(look.uv_set), TINYGLTF_TYPE_VEC2, vertices);
    any_uv_ = any_uv_ || !numbers.empty();
    const bool moved = !look.image_from_uv.matrix().isIdentity(0);
    for (std::size_t i = 0; 2 * i + 1 < numbers.size(); ++i) {
      uv[i] = {static_cast<float>(numbers[2 * i]), static_cast<float>(numbers[2 * i + 1])};
      if (moved) uv[i] = look.image_from_uv * uv[i];
    }
    return uv;
  }

  // COLOR_0 is linear; it multiplies the material's colour.
  std::vector<Vector3f> read_colors(const tinygltf::Primitive& primitive, int material, std::size_t vertices) {
    if (wanted_ == Wanted::shape) return {};
    std::vector<Vector3f> colors(vertices, Vector3f::Ones());
    const auto found = primitive.attributes.find("COLOR_0");
    if (found == primitive.attributes.end()) return colors;
    const int type = data_.at(model_.accessors, found->second, "accessor").type;
    const std::size_t parts = type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
    const auto numbers =
        attribute(primitive.attributes, "COLOR_0", parts == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, vertices);
    bool white = true;
    for (std::size_t i = 0; i < vertices; ++i)
      for (int k = 0; k < 3; ++k) {
        const auto linear = static_cast<float>(numbers[parts * i + static_cast<std::size_t>(k)]);
        white = white && linear >= 1;
        colors[i][k] = srgb_from_linear(linear * (material < 0 ? 1 : result_.materials[material].tint[k]));
      }
    if (white) return colors;
    any_color_ = true;
    if (material >= 0 && result_.materials[material].image >= 0 && !result_.materials[material].fault)
      result_.materials[material].fault.emplace(
          path_.string(), "material \"" + result_.materials[material].name +
                              "\" multiplies its image with vertex colours (COLOR_0); expected one of the two");
    return colors;
  }

  const std::filesystem::path& path_;
  const tinygltf::Model& model_;
  GlbData data_;
  Wanted wanted_;
  std::vector<std::optional<Matrix4d>> world_from_node_;  // absent: in no scene
  std::map<int, int> numbers_;
  std::vector<GlbMaterial> glb_materials_;  // as many as the result's
  FileMesh result_;
  bool any_uv_ = false, any_color_ = false;
};

}  // namespace

FileMesh read_glb_mesh(const std::filesystem::path& path, Wanted wanted) {
  const std::string where = path.string(), bytes = read_file_bytes(path, kMostMeshBytes);
  check_glb_json(where, bytes);
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
  return Reader(path, model, wanted).read();
}

}  // namespace dressform
