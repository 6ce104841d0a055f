#pragma once
#include <optional>
#include <vector>

#include "eval/metrics/trunk_section.h"

namespace dressform::metrics {

// Heights at which tapes are laid on a standing body (y up), found on the body itself, and the girths there.
struct TapeLevels {
  struct Level {
    double y = 0, girth_m = 0;
    Eigen::Vector2d center = Eigen::Vector2d::Zero();  // of the torso's section, (x, z)
    std::vector<Eigen::Vector2d> torso;                // its line
    std::vector<std::vector<Eigen::Vector2d>> limbs;   // the section's other lines
  };
  Level chest, waist, hip;
  double crotch_y = 0, armpit_y = 0;
};
// Measured on the trunk alone, without arms that touch it. Crotch: the highest level where the body is much thinner
// between the thighs than in them, so that a web between them does not move it. Armpit: where an arm's joint is a third
// as thick as the trunk. Waist: least girth over the middle 30-70 % between the two, with a strong pull to half-way: a
// belly does not drive it to chest or hips. Hip: largest girth in the lower half from crotch to waist. Chest: largest
// girth from half-way between waist and armpit to 2.8 % of the stature below the armpit. Girths are smoothed over 5 cm
// for the search only. Absent where the body is nothing of the kind.
std::optional<TapeLevels> tape_levels(const Mesh& body);

// Tape girth of a garment round the torso at a level: hull of the section's closed line round the torso's centre, if
// that goes round no limb. Where sleeve and torso's cloth are one line, or the line is open: hull of all points without
// closed lines round a limb alone, and without points nearer to a limb than to the torso; absent where these do not go
// round the torso's centre by at least 300 degrees.
std::optional<double> garment_girth_m(const Mesh& garment, const TapeLevels::Level& level);

}  // namespace dressform::metrics
