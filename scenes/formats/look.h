#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "scenes/formats/file_mesh.h"

namespace dressform {

// Steps of with_one_texture().

// One material that is drawn with its own image or as plain colour, ready to be laid beside others.
struct TextureChart {
  cv::Mat image;  // 8-bit BGR, tinted; plain: a few texels of one colour
  bool plain = false;
  std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};
  std::vector<std::size_t> triangles;  // of the mesh
};

// Lays charts side by side in one texture, each with what of its repeats the triangles touch and a border of what goes
// on beyond, so that smaller copies of the texture do not mix them. Texels keep their values, and triangles their
// texels. `names`: the charts' materials, for errors. Throws InputError where that needs too large a texture.
void lay_side_by_side(const std::string& where, const std::vector<TextureChart>& charts,
                      const std::vector<std::string>& names, TexturedMesh& result);

// A texture of one small patch for each triangle, in which its corners' colours run into one another as they do on the
// surface: within one level, next to black or saturated corners within seven (texels beyond the edge cannot go on).
void paint_corner_colors(const std::string& where, const std::vector<std::array<Vector3f, 3>>& corner_color,
                         TexturedMesh& result);

// Parts the triangles of materials whose image is one tile of several (UDIM: name.1001.png is u 0-1, v 0-1; 1002 is u
// 1-2; 1011 is v 1-2, v UP) into one material for each tile.
void part_tiles(const std::string& where, FileMesh& file);

// Leaves out the triangles that lie in a hole of their material's image. `opacity`: of each material 8-bit alpha, or
// empty. Throws InputError where a hole ends within a triangle, or cloth would be translucent.
void cut_holes(const std::string& where, const std::vector<cv::Mat>& opacity, FileMesh& file);

// The texel that stands at `i` of an endless row of which the image has the first `size`.
int wrapped(int i, int size, Wrap wrap);

// Bounds of a texture, before memory is spent on it.
constexpr int kMostTextureSide = 16384;
constexpr double kMostTexturePixels = 1 << 27;

}  // namespace dressform
