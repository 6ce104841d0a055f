#pragma once
#include <vector>

#include "scenes/scene.h"
#include "synthetic/capture/surface.h"

namespace dressform {

// The printed board in the pose: white cardboard a few millimetres thick, the pattern in carbon ink (dark for infrared
// too), with a white margin of one square. Board frame: origin at the middle of the pattern, x along the first side, y
// along the second, z into the board, away from who reads it.
RaySurface make_board(const BoardsSpec& spec, const Isometry3d& world_from_board);

// One pose a view (IR camera from board), different for every sensor name and seed: in all parts of the image, at all
// distances of the spec, turned in its plane, tilted about all axes, one in five hardly. The whole board lies in the
// infrared image, and in the colour image where there is one. Throws InputError where no pose does.
std::vector<Isometry3d> board_poses(const BoardsSpec& spec, const SensorSpec& sensor, Seed seed);

}  // namespace dressform
