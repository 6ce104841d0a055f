#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "synthetic/garments/garment_shape.h"
#include "synthetic/garments/print.h"

namespace dressform {
namespace {

constexpr double kPixelsPerMetre = 2000;
constexpr int kLargestTexture = 4096;
constexpr double kMargin = 0.006;  // cloth painted beyond the outermost triangle, m

// A piece's rectangle in metres and its place in the texture.
struct PieceRect {
  double half_width = 0, top = 1e9, bottom = -1e9;  // the middle of the piece stays in the middle
  int x = 0, y = 0, width = 0, height = 0;
};

struct Atlas {
  std::vector<PieceRect> rects;
  int width = 0, height = 0;
  double pixels_per_m = kPixelsPerMetre;
};

// Rows of pieces, as wide as the widest piece and as the first two side by side (trouser legs, front and back).
Atlas pack(std::vector<PieceRect> rects, double pixels_per_m) {
  Atlas atlas;
  atlas.pixels_per_m = pixels_per_m;
  int widest = 0;
  for (PieceRect& r : rects) {
    r.width = static_cast<int>(std::ceil(2 * r.half_width * pixels_per_m));
    r.height = static_cast<int>(std::ceil((r.bottom - r.top) * pixels_per_m));
    widest = std::max(widest, r.width);
  }
  if (rects.size() > 1) widest = std::max(widest, rects[0].width + rects[1].width);
  int x = 0, y = 0, row_height = 0;
  for (PieceRect& r : rects) {
    if (x > 0 && x + r.width > widest) {
      y += row_height;
      x = row_height = 0;
    }
    r.x = x;
    r.y = y;
    x += r.width;
    row_height = std::max(row_height, r.height);
  }
  atlas.width = widest;
  atlas.height = y + row_height;
  atlas.rects = std::move(rects);
  return atlas;
}

}  // namespace

ArcLength::ArcLength(const Tube& tube) : s_min_(tube.s_min()), rows_(tube.rows()), angles_(tube.angles()) {
  step_ = (tube.s_max() - s_min_) / (rows_ - 1);
  arcs_.resize(static_cast<size_t>(rows_) * (angles_ + 1));
  for (int row = 0; row < rows_; ++row) {
    double sum = 0;
    const auto point = [&](int i) {
      const double angle = 2 * M_PI * i / angles_, r = tube.radius(s_min_ + row * step_, angle);
      return Vector2d(r * std::cos(angle), r * std::sin(angle));
    };
    Vector2d previous = point(0);
    for (int i = 0; i <= angles_; ++i) {
      const Vector2d next = point(i % angles_);
      sum += (next - previous).norm();
      arcs_[static_cast<size_t>(row) * (angles_ + 1) + i] = sum;
      previous = next;
    }
  }
}

double ArcLength::row_at(int row, double angle) const {
  const double* arcs = &arcs_[static_cast<size_t>(row) * (angles_ + 1)];
  const double turns = angle / (2 * M_PI), whole = std::floor(turns), x = (turns - whole) * angles_;
  const int i = std::min(static_cast<int>(x), angles_ - 1);
  return whole * arcs[angles_] + arcs[i] + (x - i) * (arcs[i + 1] - arcs[i]);
}

double ArcLength::at(double s, double angle) const {
  const double x = std::clamp((s - s_min_) / step_, 0.0, rows_ - 1.0);
  const int row = std::min(static_cast<int>(x), rows_ - 2);
  const double t = x - row;
  return (1 - t) * row_at(row, angle) + t * row_at(row + 1, angle);
}

double angle_near(double angle, double near) { return near + std::remainder(angle - near, 2 * M_PI); }

namespace {

// Which piece of cloth each triangle is cut from, and where its corners lie on it, metres.
struct Pattern {
  std::vector<int> piece;
  std::vector<std::array<Vector2d, 3>> places;
  std::vector<PieceRect> rects;
};

Pattern laid_out(const Mesh& mesh, const GarmentShape& shape, const std::vector<std::array<Vector2d, 3>>& collar) {
  Pattern pattern;
  pattern.rects.resize(shape.pieces.size() + (collar.empty() ? 0 : 1));
  const size_t own = mesh.triangles.size() - collar.size();
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    const Vector3d center = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    const int piece = i < own ? shape.piece_of(center) : static_cast<int>(shape.pieces.size());
    std::array<Vector2d, 3> places;
    for (int k = 0; k < 3; ++k)
      places[k] = i < own ? shape.pieces[piece].place(mesh.vertices[t[k]], center) : collar[i - own][k];
    PieceRect& rect = pattern.rects[piece];
    for (const Vector2d& at : places) {
      rect.half_width = std::max(rect.half_width, std::abs(at.x()) + kMargin);
      rect.top = std::min(rect.top, at.y() - kMargin);
      rect.bottom = std::max(rect.bottom, at.y() + kMargin);
    }
    pattern.piece.push_back(piece);
    pattern.places.push_back(places);
  }
  return pattern;
}

// The pieces round the trunk are printed from one height to another, all of them the same.
void level_trunk(std::vector<PieceRect>& rects, const std::vector<ClothPiece>& pieces) {
  double top = 1e9, bottom = -1e9;
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (!pieces[i].trunk) continue;
    top = std::min(top, rects[i].top);
    bottom = std::max(bottom, rects[i].bottom);
  }
  for (size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].trunk) rects[i].top = top, rects[i].bottom = bottom;
}

// What is printed on a piece: text in front, bands across round the trunk.
PrintSpec print_on(const ClothPiece& piece, PrintSpec print) {
  if (!piece.text) print.text.clear();
  if (!piece.trunk && print.kind == "stripes") print.kind = "plain";
  return print;
}

}  // namespace

TexturedMesh textured_garment(const Mesh& mesh, const GarmentShape& shape,
                              const std::vector<std::array<Vector2d, 3>>& collar, const PrintSpec& print, Seed seed) {
  Pattern pattern = laid_out(mesh, shape, collar);
  level_trunk(pattern.rects, shape.pieces);
  Atlas atlas = pack(pattern.rects, kPixelsPerMetre);
  const int largest = std::max(atlas.width, atlas.height);
  if (largest > kLargestTexture) atlas = pack(pattern.rects, kPixelsPerMetre * (kLargestTexture - 8) / largest);

  TexturedMesh result;
  result.mesh = mesh;
  result.texture = cv::Mat(atlas.height, atlas.width, CV_8UC3, cv::Scalar(128, 128, 128));
  for (size_t i = 0; i < atlas.rects.size(); ++i) {
    const PieceRect& r = atlas.rects[i];
    if (r.bottom < r.top) continue;
    const PrintSpec cloth = print_on(i < shape.pieces.size() ? shape.pieces[i] : ClothPiece{}, print);
    const cv::Mat painted = paint_print(cloth, 2 * r.half_width, r.bottom - r.top, atlas.pixels_per_m, seed + i);
    cv::Mat target = result.texture(cv::Rect(r.x, r.y, r.width, r.height));
    if (painted.size() == target.size())
      painted.copyTo(target);
    else
      cv::resize(painted, target, target.size(), 0, 0, cv::INTER_AREA);
  }
  result.corner_uv.resize(mesh.triangles.size());
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const PieceRect& r = atlas.rects[pattern.piece[i]];
      const double x = r.x + (pattern.places[i][k].x() + r.half_width) * atlas.pixels_per_m;
      const double y = r.y + (pattern.places[i][k].y() - r.top) * atlas.pixels_per_m;
      result.corner_uv[i][k] = Vector2f(static_cast<float>(x / atlas.width), static_cast<float>(y / atlas.height));
    }
  return result;
}

}  // namespace dressform
