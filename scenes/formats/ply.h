#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dressform {

// A PLY file of any shape: elements of scalar and list properties, ASCII or binary of either byte order. Written by
// hand because the project's packages offer no reader that keeps unknown vertex properties, per-corner texture
// coordinates and doubles.
struct PlyProperty {
  std::string name;
  std::vector<double> values;       // one per entity; of a list: all entities' values in a row
  std::vector<std::size_t> starts;  // of a list: where each entity's values start, and the end of the last; else empty
  double full_scale = 1;            // the largest value of an 8- or 16-bit type, of any other 1
};
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  const PlyProperty* find(const std::string& property) const;
};
struct PlyFile {
  std::vector<std::string> comments;
  std::vector<PlyElement> elements;
  const PlyElement* find(const std::string& element) const;
};

// Throws InputError naming the file (and what is wrong): not a PLY, an unknown type, data that end early.
PlyFile read_ply_file(const std::filesystem::path& path);

}  // namespace dressform
