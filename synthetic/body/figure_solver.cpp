#include "synthetic/body/figure_solver.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "synthetic/body/figure_sizes.h"

namespace dressform {
namespace {

// One measured level of the trunk. Girth, breadth and depth are three measures of one outline; `fullness` is what
// makes the girth: first by a squarer section, then by breadth and depth away from their means.
class LevelSolver {
 public:
  LevelSolver(FigureShape::Level& level, double girth, double breadth, double depth, double breadth_deviation,
              double depth_deviation)
      : level_(level),
        girth_(girth),
        breadth_(breadth),
        depth_(depth),
        breadth_deviation_(breadth_deviation),
        depth_deviation_(depth_deviation) {}

  // Returns how far the girth is off. Sets the level for the next round.
  double update(double girth, double breadth, double depth) {
    const double error = girth - girth_;
    // What the girth will be once breadth and depth have been mended.
    const double mend_breadth = std::clamp((breadth_ + away() * breadth_deviation_) / breadth, 0.8, 1.25);
    const double mend_depth = std::clamp((depth_ + away() * depth_deviation_) / depth, 0.8, 1.25);
    const double left = 0.5 * (mend_breadth + mend_depth) * girth - girth_, moved = level_.fullness - before_;
    double slope = 0.15 * girth_;
    if (rounds_++ > 0 && std::abs(moved) > 1e-6)
      slope = std::clamp((left - left_before_) / moved, 0.03 * girth_, 0.5 * girth_);
    before_ = level_.fullness;
    left_before_ = left;
    const double away_before = away();
    level_.fullness = std::clamp(level_.fullness - std::clamp(left / slope, -0.5, 0.5), -8.0, 8.0);
    const double further = away() - away_before;
    level_.breadth *= mend_breadth + further * breadth_deviation_ / breadth;
    level_.depth *= mend_depth + further * depth_deviation_ / depth;
    return error;
  }

 private:
  // By how many deviations breadth and depth go away from their means.
  double away() const {
    const double full = level_.fullness, much = std::max(0.0, std::abs(full) - 3);
    return 0.94 * std::tanh(0.8 * full) + 3 * std::copysign(much, full);
  }

  FigureShape::Level& level_;
  double girth_, breadth_, depth_, breadth_deviation_, depth_deviation_;
  double before_ = 0, left_before_ = 0;
  int rounds_ = 0;
};

// A limb follows its factor almost alone.
double follow(double target, double measured, double& factor) {
  factor = std::clamp(factor * std::pow(target / std::max(measured, 0.01), 1.25), 0.5, 2.0);
  return std::abs(measured - target);
}

double follow_limbs(const Prediction& sizes, const BodySizes& found, FigureShape& shape) {
  const BodySizes &p = sizes.mean, &d = sizes.deviation;
  // The survey flexes the arm's muscles; a figure at rest stays somewhat below. A bald egg of people's breadth and
  // length is less round than their heads.
  const double off[] = {follow(p.upper_arm_girth - 0.6 * d.upper_arm_girth, found.upper_arm_girth, shape.upper_arm),
                        follow(p.forearm_girth - 0.5 * d.forearm_girth, found.forearm_girth, shape.forearm),
                        follow(p.wrist_girth, found.wrist_girth, shape.wrist),
                        follow(p.thigh_girth, found.thigh_girth, shape.thigh),
                        follow(p.lower_thigh_girth, found.lower_thigh_girth, shape.lower_thigh),
                        follow(p.calf_girth, found.calf_girth, shape.calf),
                        follow(p.ankle_girth, found.ankle_girth, shape.ankle),
                        follow(p.neck_girth, found.neck_girth, shape.neck),
                        follow(p.head_breadth + 0.5 * d.head_breadth, found.head_breadth, shape.head_breadth),
                        follow(p.head_length + 0.5 * d.head_length, found.head_length, shape.head_length)};
  return *std::max_element(std::begin(off), std::end(off));
}

double follow_ends(const Mannequin& mannequin, double wanted_crotch, FigureShape& shape) {
  const double crotch_off = crotch_height(mannequin) - wanted_crotch;
  const double crown_off = top_height(mannequin) - mannequin.landmarks.stature;
  shape.crotch_m = std::clamp(shape.crotch_m - crotch_off, -0.03, 0.03);
  shape.crown_m = std::clamp(shape.crown_m - crown_off, -0.03, 0.03);
  return std::max(std::abs(crotch_off), std::abs(crown_off));
}

}  // namespace

Mannequin solve_figure(const BodySpec& spec, const Prediction& sizes, const SolverOffsets& offsets,
                       FigureShape& shape) {
  const BodySizes &p = sizes.mean, &d = sizes.deviation;
  LevelSolver chest(shape.chest, p.chest_girth + offsets.chest, p.chest_breadth, p.chest_depth, d.chest_breadth,
                    d.chest_depth);
  LevelSolver waist(shape.waist, p.waist_girth + offsets.waist, p.waist_breadth, p.waist_depth, d.waist_breadth,
                    d.waist_depth);
  LevelSolver hip(shape.hip, p.hip_girth + offsets.hip, p.hip_breadth, p.hip_depth, d.hip_breadth, d.hip_depth);
  const double wanted_crotch = p.crotch_height + offsets.crotch;
  double worst = 0;
  for (int round = 0; round < 30; ++round) {
    Mannequin mannequin = make_mannequin(spec, p, shape);
    const Field field = [&](const Vector3d& q) { return mannequin.field(q); };
    const BodySizes found = measure_sizes(mannequin.landmarks, mannequin.joints, field_slicer(field));
    const FigureShape used = shape;
    worst = std::max({std::abs(chest.update(found.chest_girth, found.chest_breadth, found.chest_depth)),
                      std::abs(waist.update(found.waist_girth, found.waist_breadth, found.waist_depth)),
                      std::abs(hip.update(found.hip_girth, found.hip_breadth, found.hip_depth))});
    const double limbs = follow_limbs(sizes, found, shape);
    const double ends = follow_ends(mannequin, wanted_crotch, shape);
    // Nobody asks for the limbs' girths: after some rounds they are as near as this figure's can be. What is left of
    // the girths goes with what the mesh loses.
    const bool late = round >= 10;
    if (worst < (late ? 4e-4 : 1e-4) && (late || (limbs < 5e-4 && ends < 1e-3))) {
      shape = used;
      return mannequin;
    }
  }
  throw InputError("body", fmt::format("no figure has these girths (off by {:.0f} mm); expected measures of a person",
                                       1000 * worst));
}

}  // namespace dressform
