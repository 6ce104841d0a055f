#pragma once
#include "scenes/scene.h"

namespace dressform {

// The calibration that the session brings along: the true one of every sensor of the rig with the errors that the scene
// asks for, and the hand-held scanner's ("handheld") as it is.
Calibration given_calibration(const Scene& scene, Seed seed);

}  // namespace dressform
