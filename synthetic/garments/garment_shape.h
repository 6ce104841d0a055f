#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "synthetic/garments/clip.h"
#include "synthetic/garments/collar.h"
#include "synthetic/garments/drape/cloth.h"
#include "synthetic/garments/garment.h"
#include "synthetic/geometry/solid.h"

namespace dressform {

// Where a rim cuts the closed shape open.
struct RimCut {
  std::string name;
  Level beyond;  // positive where there is no cloth any more
};

// One piece of cloth in the texture. The map is in metres, to the right and down, about the piece's middle (0, 0)
// across and its top 0 down; `near` is a place in the same triangle that says on which side of the piece's cut a point
// lies.
struct ClothPiece {
  std::function<Vector2d(const Vector3d& point, const Vector3d& near)> place;
  bool text = false;   // carries the print's text
  bool trunk = false;  // goes round the trunk with the others of these: what the print runs across meets at their seams
};

// A garment as a closed solid, the cuts that open it, and the pieces it is made of.
struct GarmentShape {
  Field field;
  Field parted;  // instead of `field`, where that does not come out as planned: parts further apart; may be empty
  Eigen::AlignedBox3d box;
  std::vector<RimCut> cuts;
  std::vector<ClothPiece> pieces;
  std::vector<Level> seams;                             // triangles are split along these
  std::function<int(const Vector3d& center)> piece_of;  // of a triangle
  Fullness fullness;                                    // of the cloth against the solid
  Level held;                                           // positive where a waistband holds the cloth
  std::optional<CollarCut> collar;                      // sewn to the first cut's rim
};

// Wider by a part across the axis, as long along it.
inline Eigen::Matrix3d wider_round(const Vector3d& axis, double part) {
  return (1 + part) * Eigen::Matrix3d::Identity() - part * axis * axis.transpose();
}

GarmentShape shirt_shape(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed);
GarmentShape trousers_shape(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed);
GarmentShape skirt_shape(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed);

// Arc length round a tube by station, from angle 0, positive to the right seen from outside; goes on beyond a half
// turn.
class ArcLength {
 public:
  explicit ArcLength(const Tube& tube);
  double at(double s, double angle) const;

 private:
  double row_at(int row, double angle) const;
  double s_min_, step_;
  int rows_, angles_;
  std::vector<double> arcs_;  // rows x (angles + 1)
};

// The angle that differs from `near` by less than half a turn.
double angle_near(double angle, double near);

// Fills the texture coordinates and paints the print. collar: places of the last triangles, which are the collar's.
TexturedMesh textured_garment(const Mesh& mesh, const GarmentShape& shape,
                              const std::vector<std::array<Vector2d, 3>>& collar, const PrintSpec& print, Seed seed);

}  // namespace dressform
