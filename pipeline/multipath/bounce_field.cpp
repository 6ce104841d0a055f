#include "pipeline/multipath/bounce_field.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "pipeline/multipath/bounce_kernel.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kEmitter = 0.045;      // right of the lens, metres
constexpr float kOneSurface = 0.05f;    // largest step in depth within one surface, in parts of the depth
constexpr float kOwnNormal = 5;         // weight of a cell's own normal among its neighbours' of 1
constexpr double kLeastCovered = 0.25;  // of a cell's pixels
constexpr double kLeastSpread = 1e-4;   // of a cell's rays across, over along: pixels in one line have no slope
constexpr double kNearest = 0.3;        // metres: no sensor measures what is nearer
constexpr int kCellsAcross = 64, kLeastEdge_px = 4;  // of an image: every cell lights every other
constexpr double kLargestError = 0.06;               // metres: what comes out larger is a wrong guess at the geometry
constexpr double kMetresPerTurn = 2.0833333 / 3;     // the driver's mean over the three frequencies' cycles

double from_emitter_m(double x, double y, double z) { return std::hypot(x - kEmitter, y, z); }

double stretch_of(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z) / z; }

struct CellFit {
  double n = 0, lost = 0;  // pixels of the surface; pixels without depth beside them
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d vector = Eigen::Vector3d::Zero(), rays = Eigen::Vector3d::Zero();
  double inverse = 0, ir = 0;
};

// Whether so many of a cell's pixels make a surface: three at the least, for a plane.
bool enough(double pixels, const cv::Rect& cell) { return pixels >= std::max(3.0, kLeastCovered * cell.area()); }

// Median depth of a cell's pixels, or 0.
float median_depth(const cv::Mat& depth_mm, const cv::Rect& cell) {
  std::vector<float> depths;
  depths.reserve(cell.area());
  for (int v = cell.y; v < cell.y + cell.height; ++v)
    for (int u = cell.x; u < cell.x + cell.width; ++u)
      if (const auto d = depth_mm.at<std::uint16_t>(v, u)) depths.push_back(d);
  return enough(static_cast<double>(depths.size()), cell) ? median(std::move(depths)) : 0;
}

bool of_surface(int depth_mm, float median) {
  return depth_mm != 0 && std::abs(depth_mm - median) <= kOneSurface * median;
}

// Whether a pixel without depth has a neighbour of the surface: the driver drops the pixels of contours, and sides that
// are seen at grazing incidence with them, but the light they send goes on.
bool beside(const cv::Mat& depth_mm, int u, int v, float median) {
  const auto at = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < depth_mm.cols && y < depth_mm.rows;
    return inside && of_surface(depth_mm.at<std::uint16_t>(y, x), median);
  };
  return at(u - 1, v) || at(u + 1, v) || at(u, v - 1) || at(u, v + 1);
}

// A plane is linear in inverse depth: 1/z = n'.(ray).
CellFit sums_of(const cv::Mat& depth_mm, const cv::Mat& ir, const DepthOptics& optics, const cv::Rect& cell,
                float median) {
  CellFit fit;
  for (int v = cell.y; v < cell.y + cell.height; ++v)
    for (int u = cell.x; u < cell.x + cell.width; ++u) {
      const auto d = depth_mm.at<std::uint16_t>(v, u);
      if (d == 0) fit.lost += beside(depth_mm, u, v, median);
      if (!of_surface(d, median)) continue;
      const auto& ray = optics.rays.at<cv::Vec2d>(v, u);
      const Eigen::Vector3d direction(ray[0], ray[1], 1);
      const double inverse = 1 / (1e-3 * d - optics.calibration.depth_offset_m);
      fit.matrix += direction * direction.transpose();
      fit.vector += inverse * direction;
      fit.rays += direction;
      fit.inverse += inverse;
      if (!ir.empty()) fit.ir += ir.at<std::uint16_t>(v, u);
      fit.n += 1;
    }
  return fit;
}

void fill_cell(const CellFit& fit, const Camera& camera, int index, SurfaceCells& cells) {
  const Eigen::Vector3d centre = fit.rays / fit.n;
  // Without the centre the plane's slope is a 2 x 2 problem, and well posed whenever the pixels span a plane.
  const Eigen::Matrix3d spread = fit.matrix - fit.n * centre * centre.transpose();
  const Eigen::Vector3d right = fit.vector - fit.inverse * centre;
  const Eigen::Matrix2d slopes = spread.topLeftCorner<2, 2>();
  if (slopes.determinant() <= kLeastSpread * slopes(0, 0) * slopes(1, 1)) return;
  const Eigen::Vector2d slope = slopes.inverse() * right.head<2>();
  const double inverse = fit.inverse / fit.n;
  const Eigen::Vector3d plane(slope.x(), slope.y(), inverse - slope.dot(centre.head<2>()));
  const Eigen::Vector3d normal = -plane.normalized(), point = centre / inverse;
  if (point.z() < kNearest) return;
  cells.x[index] = static_cast<float>(point.x());
  cells.y[index] = static_cast<float>(point.y());
  cells.z[index] = static_cast<float>(point.z());
  cells.normal_x[index] = static_cast<float>(normal.x());
  cells.normal_y[index] = static_cast<float>(normal.y());
  cells.normal_z[index] = static_cast<float>(normal.z());
  const double stretch = stretch_of(point.x(), point.y(), point.z());
  cells.solid_angle[index] =
      static_cast<float>((fit.n + fit.lost) / (camera.fx * camera.fy * stretch * stretch * stretch));
  if (!cells.ir_counts.empty()) cells.ir_counts[index] = static_cast<float>(fit.ir / fit.n / 16);
}

// Mean normals of every cell and its eight neighbours where they are of one surface. The cell's own counts most: more
// smoothing turns the sides of limbs towards the sensor, and it is the sides that receive what bounced.
void smooth_normals(SurfaceCells& cells) {
  const std::vector<float> nx = cells.normal_x, ny = cells.normal_y, nz = cells.normal_z;
  for (int y = 0; y < cells.rows; ++y)
    for (int x = 0; x < cells.columns; ++x) {
      const int index = y * cells.columns + x;
      if (cells.z[index] == 0) continue;
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int v = std::max(0, y - 1); v <= std::min(cells.rows - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(cells.columns - 1, x + 1); ++u) {
          const int other = v * cells.columns + u;
          if (cells.z[other] == 0 || std::abs(cells.z[other] - cells.z[index]) > kOneSurface * cells.z[index]) continue;
          sum += (other == index ? kOwnNormal : 1.0f) * Eigen::Vector3f(nx[other], ny[other], nz[other]);
        }
      sum.normalize();
      cells.normal_x[index] = sum.x(), cells.normal_y[index] = sum.y(), cells.normal_z[index] = sum.z();
    }
}

// A cell that the image's border cuts is moved back into it: a single row of pixels has no slope.
cv::Rect inside(const cv::Rect& cell, const cv::Size& image) {
  return cv::Rect(std::min(cell.x, std::max(0, image.width - cell.width)),
                  std::min(cell.y, std::max(0, image.height - cell.height)), cell.width, cell.height) &
         cv::Rect({}, image);
}

// What the emitter sends into a direction: the lens loses four powers of the cosine to the axis, lens and emitter
// together three.
double profile_of(double stretch) { return stretch; }

double lit_cosine_of(const SurfaceCells& cells, int i) {
  return lit_cosine(cells.x[i], cells.y[i], cells.z[i],
                    Eigen::Vector3d(cells.normal_x[i], cells.normal_y[i], cells.normal_z[i]));
}

}  // namespace

SurfaceCells surface_cells(const cv::Mat& depth_mm, const cv::Mat& ir, const DepthOptics& optics) {
  SurfaceCells cells;
  cells.edge_px = std::max(kLeastEdge_px, (depth_mm.cols + kCellsAcross / 2) / kCellsAcross);
  cells.columns = (depth_mm.cols + cells.edge_px - 1) / cells.edge_px;  // the last are narrower
  cells.rows = (depth_mm.rows + cells.edge_px - 1) / cells.edge_px;
  for (auto* each :
       {&cells.x, &cells.y, &cells.z, &cells.normal_x, &cells.normal_y, &cells.normal_z, &cells.solid_angle})
    each->assign(cells.count(), 0.0f);
  if (!ir.empty()) cells.ir_counts.assign(cells.count(), 0.0f);
  for (int i = 0; i < cells.count(); ++i) {
    const cv::Point corner(i % cells.columns * cells.edge_px, i / cells.columns * cells.edge_px);
    const cv::Rect cell = inside({corner, cv::Size(cells.edge_px, cells.edge_px)}, depth_mm.size());
    const float median = median_depth(depth_mm, cell);
    if (median == 0) continue;
    const CellFit fit = sums_of(depth_mm, ir, optics, cell, median);
    if (!enough(fit.n, cell)) continue;
    fill_cell(fit, optics.calibration.ir, i, cells);
    const cv::Rect own = cv::Rect(corner, cell.br());  // less than the cell's at the image's border
    cells.solid_angle[i] *= static_cast<float>(own.area()) / static_cast<float>(cell.area());
  }
  smooth_normals(cells);
  return cells;
}

double lit_cosine(double x, double y, double z, const Eigen::Vector3d& normal) {
  return -normal.dot(Eigen::Vector3d(x - kEmitter, y, z)) / from_emitter_m(x, y, z);
}

double direct_light(double x, double y, double z, double cosine) {
  const double way = from_emitter_m(x, y, z);
  return profile_of(stretch_of(x, y, z)) * std::max(kLeastLitCosine, cosine) / (way * way);
}

double light_per_count(double x, double y, double z, double signal_counts) {
  return std::pow(stretch_of(x, y, z), 4) / signal_counts;
}

std::vector<float> albedo_of(const SurfaceCells& cells, double signal_counts) {
  std::vector<float> albedo(cells.count(), 0.0f);
  for (int i = 0; i < cells.count(); ++i) {
    if (cells.z[i] == 0) continue;
    const double x = cells.x[i], y = cells.y[i], z = cells.z[i];
    albedo[i] = static_cast<float>(std::clamp(
        cells.ir_counts[i] * light_per_count(x, y, z, signal_counts) / direct_light(x, y, z, lit_cosine_of(cells, i)),
        0.0, 1.0));
  }
  return albedo;
}

BouncedLight bounced_light(const SurfaceCells& cells, const std::vector<float>& albedo) {
  const int count = cells.count();
  BouncedLight result{count, std::vector<float>(static_cast<std::size_t>(BouncedLight::terms) * count, 0.0f)};
  std::vector<float> way(count, 0.0f);
  float *cosine[bounce::frequencies], *sine[bounce::frequencies];
  for (int f = 0; f < bounce::frequencies; ++f) {
    cosine[f] = &result.sums[static_cast<std::size_t>(2 * f) * count];
    sine[f] = &result.sums[static_cast<std::size_t>(2 * f + 1) * count];
  }
  for (int i = 0; i < count; ++i) way[i] = static_cast<float>(from_emitter_m(cells.x[i], cells.y[i], cells.z[i]));
  const bounce::Receivers receivers{cells.x.data(),        cells.y.data(),        cells.z.data(), cells.normal_x.data(),
                                    cells.normal_y.data(), cells.normal_z.data(), way.data(),     count};
  for (int i = 0; i < count; ++i) {
    if (cells.z[i] == 0 || albedo[i] <= 0) continue;
    const double stretch = stretch_of(cells.x[i], cells.y[i], cells.z[i]);
    const double light = albedo[i] / M_PI * profile_of(stretch) * cells.solid_angle[i];
    const double across = cells.z[i] * stretch;
    bounce::add_source({cells.x[i], cells.y[i], cells.z[i], cells.normal_x[i], cells.normal_y[i], cells.normal_z[i],
                        way[i], static_cast<float>(light), static_cast<float>(cells.solid_angle[i] * across * across)},
                       receivers, cosine, sine);
  }
  return result;
}

double bounce_error_m(double direct, const float (&bounced)[BouncedLight::terms], double stretch) {
  double turns = 0;
  for (int f = 0; f < bounce::frequencies; ++f)
    turns += std::atan2(static_cast<double>(bounced[2 * f + 1]), direct + bounced[2 * f]) / (2 * M_PI);
  return std::clamp(kMetresPerTurn * turns / stretch, -kLargestError, kLargestError);
}

std::vector<float> bounce_errors_m(const SurfaceCells& cells, const BouncedLight& light) {
  std::vector<float> errors(cells.count(), 0.0f);
  for (int i = 0; i < cells.count(); ++i) {
    if (cells.z[i] == 0) continue;
    float bounced[BouncedLight::terms];
    for (int t = 0; t < BouncedLight::terms; ++t) bounced[t] = light.term(t)[i];
    errors[i] =
        static_cast<float>(bounce_error_m(direct_light(cells.x[i], cells.y[i], cells.z[i], lit_cosine_of(cells, i)),
                                          bounced, stretch_of(cells.x[i], cells.y[i], cells.z[i])));
  }
  return errors;
}

}  // namespace dressform
