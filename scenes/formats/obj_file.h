#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// A Wavefront OBJ as it is written: polygons, with names of materials. Read by hand because the project's packages
// offer no reader that keeps double precision, names with blanks and the line of a fault.
struct ObjFile {
  struct Corner {
    int vertex, uv;  // uv -1: none
  };
  std::vector<Vector3d> vertices;
  std::vector<Vector3f> colors;  // sRGB; empty, or as many as vertices
  std::vector<Vector2f> uv;      // v UP
  std::vector<Corner> corners;   // of all polygons in a row
  struct Polygon {
    std::size_t end;  // of its corners
    int line, material;
  };
  std::vector<Polygon> polygons;
  std::vector<std::string> materials;  // names, in the order of first use
  std::vector<std::string> libraries;  // the rest of each mtllib line
};

// `text`: the whole file. Throws InputError naming file and line: a number that is none, a corner that does not exist,
// a face with fewer than three.
ObjFile read_obj_file(const std::filesystem::path& path, const std::string& text);

}  // namespace dressform
