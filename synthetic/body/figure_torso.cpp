#include <algorithm>

#include "synthetic/body/figure.h"

namespace dressform {
namespace {

double mix(double a, double b, double t) { return a + t * (b - a); }

// A section of the trunk by half-breadth, depth and the part of the depth that lies in front of the axis.
LimbSection trunk_ring(double y, double half, double depth, double front_part, double exponent) {
  return {y, {0, 0}, half, half, depth * front_part, depth * (1 - front_part), exponent};
}

std::vector<LimbSection> trunk(const FigurePlan& plan) {
  const BodySizes& p = plan.sizes;
  const BodyLandmarks& m = plan.marks;
  const double waist_chest = m.chest - m.waist, hip_waist = m.waist - m.hip,
               low = std::min(m.crotch + plan.shape.crotch_m, m.hip - 0.034);
  const double neck_half = 0.5 * p.neck_girth / M_PI, acromion = 0.5 * p.biacromial_breadth, yoke = m.neck - m.shoulder;
  // What the breast and the shoulder blades add to the chest is left out here.
  const double chest_front = plan.female ? 0.41 : 0.498, chest_back = 0.495;
  const double chest = plan.chest_depth * (chest_front + chest_back),
               chest_part = chest_front / (chest_front + chest_back);
  const double hip_back = 0.44, hip_front = 0.44;  // the buttocks make up the rest
  const double hip = plan.hip_depth * (hip_front + hip_back), ribs = plan.female ? 0.95 : 1.0;
  const double belly = std::max(plan.waist_depth * 0.54, plan.hip_depth * hip_front);
  return {
      trunk_ring(low, 0.14 * plan.hip_half, 0.24 * hip, 0.46, 2),
      trunk_ring(mix(low, m.hip, 0.30), 0.36 * plan.hip_half, 0.44 * hip, 0.47, 2),
      trunk_ring(mix(low, m.hip, 0.75), 0.58 * plan.hip_half, 0.66 * hip, 0.48, 2.1),
      trunk_ring(m.hip + 0.10 * hip_waist, 0.84 * plan.hip_half, 0.88 * hip, 0.49, 2.2),
      trunk_ring(m.hip + 0.28 * hip_waist, 0.95 * plan.hip_half, 0.985 * hip, 0.5, plan.shape.hip.exponent()),
      {m.hip + 0.60 * hip_waist,
       {0, 0},
       mix(plan.hip_half, plan.waist_half, plan.female ? 0.42 : 0.38),
       mix(plan.hip_half, plan.waist_half, plan.female ? 0.42 : 0.38),
       mix(plan.hip_depth * hip_front, belly, 0.75),
       mix(plan.hip_depth * hip_back, plan.waist_depth * 0.46, 0.65),
       mix(plan.shape.hip.exponent(), plan.shape.waist.exponent(), 0.45)},
      trunk_ring(m.waist, plan.waist_half, plan.waist_depth, 0.54, plan.shape.waist.exponent()),
      {m.waist + 0.5 * waist_chest,
       {0, 0},
       ribs * mix(plan.waist_half, plan.chest_half, 0.55),
       ribs * mix(plan.waist_half, plan.chest_half, 0.55),
       mix(0.54 * plan.waist_depth, chest_front * plan.chest_depth, 0.55),
       mix(0.46 * plan.waist_depth, 0.485 * plan.chest_depth, 0.55),
       mix(plan.shape.waist.exponent(), 2.8, 0.7)},
      trunk_ring(mix(m.waist, m.chest, 0.82), mix(plan.waist_half, plan.chest_half, 0.9),
                 mix(plan.waist_depth, chest, 0.88), chest_part, mix(2.8, plan.shape.chest.exponent(), 0.45)),
      trunk_ring(m.chest, plan.chest_half, chest, chest_part, plan.shape.chest.exponent()),
      trunk_ring(m.armpit, 0.955 * plan.chest_half, 0.975 * chest, chest_part - 0.02,
                 mix(2.6, plan.shape.chest.exponent(), 0.5)),
      trunk_ring(mix(m.armpit, m.shoulder, 0.55), 0.80 * acromion, 0.88 * chest, 0.42, 2.3),
      trunk_ring(m.shoulder - 0.012, 0.74 * acromion, 0.68 * chest, 0.31, 2.1),
      trunk_ring(m.shoulder + 0.30 * yoke, 0.52 * acromion, 0.52 * chest, 0.20, 2),
      trunk_ring(m.shoulder + 0.62 * yoke, 0.90 * neck_half, 0.40 * chest, 0.14, 2),
      trunk_ring(m.shoulder + 0.80 * yoke, 0.60 * neck_half, 0.28 * chest, 0.12, 2),
  };
}

// Breast bones, muscles and blades that make a chest of the rounded box.
void add_chest(const FigurePlan& plan, Solid& solid) {
  const BodyLandmarks& m = plan.marks;
  const double half = plan.chest_half, depth = plan.chest_depth, h = m.stature;
  if (plan.female) {
    const double size = 0.150 * depth + 0.026, x = 0.54 * half, tip = 0.5 * depth;
    const Vector3d center(x, m.chest - 0.002 * h, tip - 0.92 * size);
    solid.add_ellipsoid(center, {0.96 * size, size, 0.92 * size}, 0.030);
    solid.add_capsule(center + Vector3d(0.012, 0.062 * h / 1.63, -0.55 * size), center + Vector3d(0, 0, -0.10 * size),
                      0.45 * size, 0.78 * size, 0.035);
  } else {
    solid.add_ellipsoid({0.50 * half, m.chest + 0.014 * h, 0.5 * depth - 0.042}, {0.43 * half, 0.042 * h, 0.034},
                        0.022);
  }
  solid.add_ellipsoid({0.50 * half, m.chest + 0.022 * h, -0.5 * depth + 0.046}, {0.42 * half, 0.054 * h, 0.036}, 0.024);
  // From the neck down to the point of the shoulder.
  const double acromion = 0.5 * plan.sizes.biacromial_breadth, neck = 0.5 * plan.sizes.neck_girth / M_PI;
  solid.add_capsule({0.42 * neck, m.neck - 0.026 * h, -0.044}, {0.86 * acromion, m.shoulder - 0.025 * h, -0.028},
                    plan.female ? 0.030 : 0.037, plan.female ? 0.028 : 0.034, 0.045);
}

}  // namespace

void add_torso(const FigurePlan& plan, Solid& solid) {
  const BodyLandmarks& m = plan.marks;
  solid.add(Tube::from_sections({}, trunk(plan)), 0);
  add_chest(plan, solid);
  // Buttocks.
  const double deep = 0.5 * plan.hip_depth, round = 0.30 * plan.hip_depth;
  solid.add_ellipsoid({0.46 * plan.hip_half, m.hip - 0.002 * m.stature, -deep + round},
                      {0.47 * plan.hip_half, 0.056 * m.stature, round}, 0.028);
}

}  // namespace dressform
