#pragma once
#include <optional>
#include <vector>

#include "scenes/mesh.h"

namespace dressform::metrics {

// One connected line of a horizontal section, as (x, z).
struct SectionLine {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
};
// Section of a mesh with the plane at height y (vertices at y count as above).
std::vector<SectionLine> horizontal_section(const Mesh& mesh, double y);

// Length of the convex hull's outline: what a tape measures.
double hull_girth_m(const std::vector<Eigen::Vector2d>& points);

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
// Torso: the section's line of the largest area. Crotch: the highest section with two lines of like area. Armpit: the
// lowest section above where the torso's girth grows by 8 % within 2 cm (the arms join it). Waist: least girth in the
// middle 70 % between them; hip: most between crotch and waist; chest: most from halfway between waist and armpit to 2
// % of the stature below the armpit. Girths are smoothed over 5 cm. Absent where the body is nothing of the kind.
std::optional<TapeLevels> tape_levels(const Mesh& body);

// Tape girth of a garment round the torso at a level: hull of the section's line that goes round the torso's centre (by
// at least 300 degrees), without its points that lie nearer to a limb than to the torso: sleeves are left out also
// where they join the torso. Absent where the garment does not go round.
std::optional<double> garment_girth_m(const Mesh& garment, const TapeLevels::Level& level);

}  // namespace dressform::metrics
