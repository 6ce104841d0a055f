#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/formats/file_mesh.h"

namespace dressform {

// A material of an MTL file (Wavefront, "Object Files", appendix B1), with how its image lies on the surface.
struct MtlMaterial {
  FileMaterial material;  // `image` and `opacity_image` unset
  std::filesystem::path color_file, opacity_file;
  std::array<Vector2f, 2> scale_offset{Vector2f::Ones(), Vector2f::Zero()};  // -s and -o: uv (v UP) times, plus
};

// Adds the materials of one library to those known by name; of two with one name the first stays. Names may hold
// blanks, paths may be written with backslashes. What cannot be drawn as it is meant is the material's `fault`.
void read_mtl(const std::filesystem::path& path, std::map<std::string, MtlMaterial>& materials);

// `text` without blanks and quotation marks round it.
std::string_view trimmed(std::string_view text);

// A file that another one names, with slashes or backslashes, from that one's folder.
std::filesystem::path beside(const std::filesystem::path& file, std::string_view name);

}  // namespace dressform
