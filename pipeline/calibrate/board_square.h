#pragma once
#include "pipeline/calibrate/board_views.h"

namespace dressform {

// What the corners of a sensor's boards say of their distance without any depth (focal length by how tilted boards
// foreshorten; Zhang, PAMI 2000), against the depth measured on them. Both grow with the distance, the first with the
// squares' side as well: their ratio is 1 where the side is right.
struct SquareEvidence {
  double depth_ratio = 1;  // measured distance of a board over that by its corners, median over views
  double sigma = 1;        // of that, relative, from the focal length's
  double scatter = 0;      // of the views' ratios about that, relative, median
  int views = 0;           // with corners and depth
};
SquareEvidence square_evidence(const SensorBoards& boards);

// Throws InputError, naming the board's square and the side that depth gives, where depth and corners contradict it by
// more than a depth camera's error can; where boards that are all frontal leave the focal length open, by more than any
// lens could make up for.
void check_square(const SensorBoards& boards);

}  // namespace dressform
