#include "synthetic/boards/board.h"

#include <opencv2/imgproc.hpp>

#include "synthetic/capture/shapes.h"

namespace dressform {
namespace {

constexpr int square_texels = 32;
const cv::Scalar paper(240, 242, 243), ink(42, 42, 44);  // sRGB

// Margins of one square round the pattern; the first square is dark.
cv::Mat painted(const BoardsSpec& spec) {
  cv::Mat image((spec.squares_y + 2) * square_texels, (spec.squares_x + 2) * square_texels, CV_8UC3, paper);
  for (int y = 0; y < spec.squares_y; ++y)
    for (int x = y % 2; x < spec.squares_x; x += 2)
      cv::rectangle(image, cv::Rect((x + 1) * square_texels, (y + 1) * square_texels, square_texels, square_texels),
                    ink, cv::FILLED);
  return image;
}

}  // namespace

RaySurface make_board(const BoardsSpec& spec, const Isometry3d& world_from_board) {
  RaySurface board;
  board.name = "board";
  board.smooth = false;
  const Vector3d u(spec.square_m * (spec.squares_x + 2), 0, 0), v(0, spec.square_m * (spec.squares_y + 2), 0);
  const Vector3d corner = -0.5 * (u + v);
  board.mesh = grid_mesh(corner, u, v, 0.1);
  board.corner_uv = grid_uv(board.mesh, corner, u, v);
  for (auto& vertex : board.mesh.vertices) vertex = world_from_board * vertex;
  board.texture = painted(spec);
  board.material.albedo_rgb = Vector3f::Constant(0.92f);
  board.material.nir_albedo = 0.40f;  // 0.07 on ink, 0.67 on paper
  board.material.nir_print = 1.68f;
  return board;
}

}  // namespace dressform
