#include "synthetic/garments/tube.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr double kTwoPi = 6.283185307179586;

// Members of a section as one array, for interpolation.
using Packed = Eigen::Matrix<double, 7, 1>;
Packed pack(const LimbSection& x) {
  Packed p;
  p << x.center.x(), x.center.y(), x.u_plus, x.u_minus, x.v_plus, x.v_minus, x.exponent;
  return p;
}
// Beside a section of a far greater exponent the spline swings below what any section has: below 1 the outline would be
// a star, below 0 the whole plane.
constexpr double kLeastExponent = 1.8;
LimbSection unpack(double s, const Packed& p) {
  return {s, {p[0], p[1]}, p[2], p[3], p[4], p[5], std::max(kLeastExponent, p[6])};
}

// Slope at section i for a Catmull-Rom spline over uneven stations.
Packed tangent(const std::vector<LimbSection>& x, int i) {
  const int last = static_cast<int>(x.size()) - 1;
  const int before = std::max(i - 1, 0), after = std::min(i + 1, last);
  return (pack(x[after]) - pack(x[before])) / (x[after].s - x[before].s);
}

}  // namespace

double LimbSection::radius(double angle) const {
  const double c = std::cos(angle), s = std::sin(angle);
  const double a = c >= 0 ? u_plus : u_minus, b = s >= 0 ? v_plus : v_minus;
  return std::pow(std::pow(std::abs(c) / a, exponent) + std::pow(std::abs(s) / b, exponent), -1 / exponent);
}

double LimbSection::perimeter() const {
  constexpr int kSteps = 180;
  double sum = 0;
  Vector2d previous(radius(0), 0);
  for (int i = 1; i <= kSteps; ++i) {
    const double angle = kTwoPi * i / kSteps, r = radius(angle);
    const Vector2d next(r * std::cos(angle), r * std::sin(angle));
    sum += (next - previous).norm();
    previous = next;
  }
  return sum;
}

LimbSection LimbSection::scaled_to_perimeter(double perimeter_m) const {
  const double factor = perimeter_m / perimeter();
  LimbSection result = *this;
  for (double LimbSection::*side :
       {&LimbSection::u_plus, &LimbSection::u_minus, &LimbSection::v_plus, &LimbSection::v_minus})
    result.*side *= factor;
  return result;
}

LimbSection interpolate(const std::vector<LimbSection>& sections, double s) {
  if (s <= sections.front().s) return sections.front();
  if (s >= sections.back().s) return sections.back();
  int i = 0;
  while (sections[i + 1].s < s) ++i;
  const double span = sections[i + 1].s - sections[i].s, t = (s - sections[i].s) / span;
  const double h00 = (1 + 2 * t) * (1 - t) * (1 - t), h10 = t * (1 - t) * (1 - t);
  const double h01 = t * t * (3 - 2 * t), h11 = t * t * (t - 1);
  return unpack(s, h00 * pack(sections[i]) + h10 * span * tangent(sections, i) + h01 * pack(sections[i + 1]) +
                       h11 * span * tangent(sections, i + 1));
}

Tube Tube::from_sections(const Frame& frame, const std::vector<LimbSection>& sections) {
  constexpr int kAngles = 96;
  const double first = sections.front().s, length = sections.back().s - first;
  const int rows = std::max(8, static_cast<int>(std::ceil(length / 0.004))) + 1;
  const double step = length / (rows - 1);
  std::vector<double> radii;
  std::vector<Vector2d> centers;
  radii.reserve(rows * kAngles);
  for (int row = 0; row < rows; ++row) {
    const LimbSection section = interpolate(sections, first + row * step);
    centers.push_back(section.center);
    for (int i = 0; i < kAngles; ++i) radii.push_back(section.radius(kTwoPi * i / kAngles));
  }
  return Tube(frame, first, step, kAngles, std::move(radii), std::move(centers));
}

Tube::Tube(const Frame& frame, double s_min, double step, int angles, std::vector<double> radii,
           std::vector<Vector2d> centers)
    : frame_(frame),
      s_min_(s_min),
      step_(step),
      angles_(angles),
      radii_(std::move(radii)),
      centers_(std::move(centers)) {
  largest_radius_ = *std::max_element(radii_.begin(), radii_.end());
}

Vector2d Tube::center(double s) const {
  const double x = std::clamp((s - s_min_) / step_, 0.0, rows() - 1.0);
  const int row = std::min(static_cast<int>(x), rows() - 2);
  const double t = x - row;
  return (1 - t) * centers_[row] + t * centers_[row + 1];
}

double Tube::radius(double s, double angle) const {
  const double x = std::clamp((s - s_min_) / step_, 0.0, rows() - 1.0);
  const int row = std::min(static_cast<int>(x), rows() - 2);
  double turn = angle / kTwoPi;
  turn = (turn - std::floor(turn)) * angles_;
  const int column = std::min(static_cast<int>(turn), angles_ - 1), next = (column + 1) % angles_;
  const double t = x - row, a = turn - column;
  const double* low = &radii_[row * angles_];
  const double* high = low + angles_;
  return (1 - t) * ((1 - a) * low[column] + a * low[next]) + t * ((1 - a) * high[column] + a * high[next]);
}

Vector3d Tube::polar(const Vector3d& point) const {
  const Vector3d d = point - frame_.origin;
  const double s = d.dot(frame_.axis);
  const Vector2d across = Vector2d(d.dot(frame_.u), d.dot(frame_.v)) - center(s);
  return {s, std::atan2(across.y(), across.x()), across.norm()};
}

Vector3d Tube::point(double s, double angle, double radius) const {
  const Vector2d c = center(s);
  return frame_.origin + s * frame_.axis + (c.x() + radius * std::cos(angle)) * frame_.u +
         (c.y() + radius * std::sin(angle)) * frame_.v;
}

double Tube::field(const Vector3d& p) const {
  const Vector3d d = p - frame_.origin;
  const double s = d.dot(frame_.axis), inside_s = std::clamp(s, s_min_, s_max());
  const double x = (inside_s - s_min_) / step_;
  const int row = std::min(static_cast<int>(x), rows() - 2);
  const double t = x - row;
  const Vector2d shift = centers_[row + 1] - centers_[row];
  const Vector2d across = Vector2d(d.dot(frame_.u), d.dot(frame_.v)) - centers_[row] - t * shift;
  const double rho = across.norm();

  double turn = std::atan2(across.y(), across.x()) / kTwoPi;
  turn = (turn - std::floor(turn)) * angles_;
  const int column = std::min(static_cast<int>(turn), angles_ - 1), next = (column + 1) % angles_;
  const double a = turn - column;
  const double* low = &radii_[row * angles_];
  const double* high = low + angles_;
  const double r_low = (1 - a) * low[column] + a * low[next], r_high = (1 - a) * high[column] + a * high[next];
  const double r = (1 - t) * r_low + t * r_high;
  // Slopes of the radius along the axis (the moving center counts as well) and around it.
  const double lean = rho > 1e-9 ? shift.dot(across) / rho : 0;
  const double along = (r_high - r_low + lean) / step_;
  const double around = ((1 - t) * (low[next] - low[column]) + t * (high[next] - high[column])) * angles_ / kTwoPi;
  const double slope = around / std::max(rho, 0.5 * r);
  const double distance = (rho - r) / std::sqrt(1 + along * along + slope * slope);

  const double beyond = std::abs(s - inside_s);
  if (beyond == 0) return distance;
  return distance > 0 ? std::hypot(distance, beyond) : std::max(distance, beyond);
}

}  // namespace dressform
