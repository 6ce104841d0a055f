#include "scenes/formats/glb_data.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "scenes/formats/file_mesh.h"

namespace dressform {
namespace {

template <class T>
void copy_numbers(const unsigned char* bytes, std::size_t stride, std::size_t count, int components, double scale,
                  double* out) {
  for (std::size_t i = 0; i < count; ++i, bytes += stride)
    for (int k = 0; k < components; ++k) {
      T value;
      std::memcpy(&value, bytes + static_cast<std::size_t>(k) * sizeof(T), sizeof(T));
      *out++ = scale * static_cast<double>(value);
    }
}

// False for a component type that glTF does not know.
bool copy_numbers(int component_type, bool normalized, const unsigned char* bytes, std::size_t stride,
                  std::size_t count, int components, double* out) {
  const auto scale = [&](double largest) { return normalized ? 1 / largest : 1; };
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      copy_numbers<std::int8_t>(bytes, stride, count, components, scale(127), out);
      return true;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      copy_numbers<std::uint8_t>(bytes, stride, count, components, scale(255), out);
      return true;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      copy_numbers<std::int16_t>(bytes, stride, count, components, scale(32767), out);
      return true;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      copy_numbers<std::uint16_t>(bytes, stride, count, components, scale(65535), out);
      return true;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      copy_numbers<std::uint32_t>(bytes, stride, count, components, 1, out);
      return true;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      copy_numbers<float>(bytes, stride, count, components, 1, out);
      return true;
  }
  return false;
}

// The JSON of a GLB. The libraries walk nested values by recursion: how deep they are is bounded.
std::string_view checked_json(const std::string& where, const std::string& bytes) {
  constexpr std::size_t kStart = 20;  // header, and that of the first chunk
  constexpr int kDeepestJson = 100;
  if (bytes.size() < kStart) throw InputError(where, "the file is too short; expected a GLB");
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof size);
  const std::string_view json = std::string_view(bytes).substr(kStart, size);
  int depth = 0;
  for (char c : json) {
    depth += c == '[' || c == '{';
    depth -= c == ']' || c == '}';
    if (depth > kDeepestJson) throw InputError(where, "its JSON is nested too deep; expected a glTF");
  }
  return json;
}

// Throws InputError naming every extension that the file requires and the reader does not know. Looked at first: data
// that an extension has packed are no valid glTF.
void check_required_extensions(const std::string& where, std::string_view text) {
  static const std::set<std::string> known{
      "KHR_texture_transform",     "KHR_mesh_quantization",   "KHR_materials_unlit", "KHR_materials_specular",
      "KHR_materials_sheen",       "KHR_materials_clearcoat", "KHR_materials_ior",   "KHR_materials_emissive_strength",
      "KHR_materials_iridescence", "KHR_materials_anisotropy"};
  const auto json = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  if (!json.is_object() || !json.contains("extensionsRequired")) return;
  std::string missing;
  for (const auto& name : json["extensionsRequired"])
    if (!name.is_string() || !known.count(name.get<std::string>()))
      missing += (missing.empty() ? "" : ", ") + (name.is_string() ? name.get<std::string>() : "that has no name");
  if (!missing.empty())
    throw InputError(where, "requires the extension " + missing +
                                ", which is not read; expected a file exported without it (no compression, PNG or JPEG "
                                "images)");
}

}  // namespace

void check_glb_json(const std::string& where, const std::string& bytes) {
  check_required_extensions(where, checked_json(where, bytes));
}

std::size_t GlbData::count(int accessor) const { return at(model_.accessors, accessor, "accessor").count; }

GlbData::Block GlbData::block(int view_number, std::size_t offset, std::size_t stride, std::size_t element,
                              std::size_t count) const {
  const tinygltf::BufferView& view = at(model_.bufferViews, view_number, "buffer view");
  const tinygltf::Buffer& buffer = at(model_.buffers, view.buffer, "buffer");
  const std::size_t size = buffer.data.size(), start = view.byteOffset + offset;
  const bool inside = view.byteOffset <= size && offset <= size && start + element <= size &&
                      (count == 0 || count - 1 <= (size - start - element) / stride);
  if (!inside)
    fail("buffer view " + std::to_string(view_number) + " leaves its buffer; the file is truncated or damaged");
  return {buffer.data.data() + start, stride};
}

std::vector<double> GlbData::numbers(int index, int type) const {
  const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
  const std::string name = "accessor " + std::to_string(index);
  if (accessor.type != type) fail(name + " has another type; expected " + std::to_string(type) + " numbers an element");
  if (accessor.count > 3 * kMostVertices)
    fail(name + " has " + std::to_string(accessor.count) + " elements; expected at most " +
         std::to_string(3 * kMostVertices));
  const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
  if (components <= 0 || size <= 0) fail(name + " has an unknown component type; expected one of glTF's");
  if (accessor.bufferView < 0 && !accessor.sparse.isSparse)
    fail(name + " has no buffer view; expected data (an extension may have packed them)");
  std::vector<double> result;
  const auto element = static_cast<std::size_t>(components * size);
  if (accessor.bufferView >= 0) {
    const int stride = accessor.ByteStride(at(model_.bufferViews, accessor.bufferView, "buffer view"));
    if (stride <= 0) fail(name + " has no valid step");
    const Block data =
        block(accessor.bufferView, accessor.byteOffset, static_cast<std::size_t>(stride), element, accessor.count);
    result.resize(accessor.count * static_cast<std::size_t>(components));
    copy_numbers(accessor.componentType, accessor.normalized, data.bytes, data.stride, accessor.count, components,
                 result.data());
  } else {
    result.resize(accessor.count * static_cast<std::size_t>(components));
  }
  if (accessor.sparse.isSparse) put_sparse(accessor, components, result);
  return result;
}

void GlbData::put_sparse(const tinygltf::Accessor& accessor, int components, std::vector<double>& numbers) const {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count)
    fail("a sparse accessor has more values than elements");
  const auto count = static_cast<std::size_t>(sparse.count), parts = static_cast<std::size_t>(components);
  const auto size_of = [](int type) {
    return static_cast<std::size_t>(std::max(0, tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type))));
  };
  const std::size_t index_size = size_of(sparse.indices.componentType), size = size_of(accessor.componentType);
  if (index_size == 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
    fail("a sparse accessor has no valid indices");
  const Block at_indices = block(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                                 index_size, index_size, count);
  const Block at_values = block(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                                parts * size, parts * size, count);
  std::vector<double> indices(count), values(count * parts);
  copy_numbers(sparse.indices.componentType, false, at_indices.bytes, at_indices.stride, count, 1, indices.data());
  copy_numbers(accessor.componentType, accessor.normalized, at_values.bytes, at_values.stride, count, components,
               values.data());
  for (std::size_t i = 0; i < count; ++i) {
    if (!(indices[i] >= 0 && indices[i] < static_cast<double>(accessor.count)))
      fail("a sparse accessor names an element that does not exist");
    for (std::size_t k = 0; k < parts; ++k)
      numbers[static_cast<std::size_t>(indices[i]) * parts + k] = values[i * parts + k];
  }
}

}  // namespace dressform
