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

// Rows of pieces, each as wide as the widest piece at least.
Atlas pack(std::vector<PieceRect> rects, double pixels_per_m) {
  Atlas atlas;
  atlas.pixels_per_m = pixels_per_m;
  int widest = 0;
  for (PieceRect& r : rects) {
    r.width = static_cast<int>(std::ceil(2 * r.half_width * pixels_per_m));
    r.height = static_cast<int>(std::ceil((r.bottom - r.top) * pixels_per_m));
    widest = std::max(widest, r.width);
  }
  // Two tall pieces stand side by side (trouser legs).
  if (rects.size() == 2) widest = rects[0].width + rects[1].width;
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

TexturedMesh textured_garment(const Mesh& mesh, const GarmentShape& shape, const PrintSpec& print, Seed seed) {
  std::vector<PieceRect> rects(shape.pieces.size());
  std::vector<int> piece(mesh.triangles.size());
  std::vector<std::array<Vector2d, 3>> places(mesh.triangles.size());
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    const Vector3d center = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    piece[i] = shape.piece_of(center);
    PieceRect& rect = rects[piece[i]];
    for (int k = 0; k < 3; ++k) {
      const Vector2d at = places[i][k] = shape.pieces[piece[i]].place(mesh.vertices[t[k]], center);
      rect.half_width = std::max(rect.half_width, std::abs(at.x()) + kMargin);
      rect.top = std::min(rect.top, at.y() - kMargin);
      rect.bottom = std::max(rect.bottom, at.y() + kMargin);
    }
  }
  Atlas atlas = pack(rects, kPixelsPerMetre);
  const int largest = std::max(atlas.width, atlas.height);
  if (largest > kLargestTexture) atlas = pack(rects, kPixelsPerMetre * (kLargestTexture - 8) / largest);

  TexturedMesh result;
  result.mesh = mesh;
  result.texture = cv::Mat(atlas.height, atlas.width, CV_8UC3, cv::Scalar(128, 128, 128));
  for (size_t i = 0; i < atlas.rects.size(); ++i) {
    const PieceRect& r = atlas.rects[i];
    if (r.bottom < r.top) continue;
    PrintSpec cloth = print;
    if (!shape.pieces[i].front) {
      cloth.text.clear();
      if (cloth.kind == "stripes") cloth.kind = "plain";
    }
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
      const PieceRect& r = atlas.rects[piece[i]];
      const double x = r.x + (places[i][k].x() + r.half_width) * atlas.pixels_per_m;
      const double y = r.y + (places[i][k].y() - r.top) * atlas.pixels_per_m;
      result.corner_uv[i][k] = Vector2f(static_cast<float>(x / atlas.width), static_cast<float>(y / atlas.height));
    }
  return result;
}

}  // namespace dressform
