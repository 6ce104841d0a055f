#pragma once
#include <optional>
#include <string>

#include "scenes/capture_session.h"

namespace dressform {

// What a person, a room, a printed board and a depth camera can be: the bounds that every reader of recorded data
// shares. Each check says what was found (with numbers), what was expected, what the likely cause is and how to say it
// right; the reader names the file.

// A field of what was checked, "" for the whole, and the problem with it, as InputError takes it.
struct FieldProblem {
  std::string field, problem;
};

// A pinhole camera of images of its own size: positive focal lengths that give a field of view between a telescope's
// and a fisheye's, pixels that are nearly square, a principal point inside the image, distortion as lenses have it.
std::optional<FieldProblem> problem_with(const Camera& camera);

// The cameras of one sensor and the step between them: fields "ir.fx", "color_from_ir", "depth_offset_m", ...
std::optional<FieldProblem> problem_with(const SensorCalibration& sensor);

// A printed checkerboard that a person can hold before a camera; empty: it may be one.
std::string problem_with_board(int inner_corners_x, int inner_corners_y, double square_m);

// Poses of a rig round a mannequin (world: metres, y up, floor y = 0): stand in a room, above its floor. Where most
// sensors look past the mannequin and another reading of the same numbers (the inverse, the transposed rotation, z up,
// y or z of the camera the other way round) has all of them look at it, the prior is taken to be written that way.
// Field: the sensor, or "" for all.
std::optional<FieldProblem> problem_with_prior(const RigPrior& prior);

// " (looks like centimetres: ...)" where a length that is too large, divided by what a unit has in a metre, is as
// usual; else nothing.
std::string unit_guess(double found, double usual_least_m, double usual_most_m);

}  // namespace dressform
