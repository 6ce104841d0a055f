#pragma once
#include <map>
#include <string>

#include "synthetic/operator/body_pairs.h"
#include "synthetic/operator/rim_picks.h"
#include "synthetic/synthesize.h"

namespace dressform {

// Plays the thesis's operator from the truth: what a person who saw the captures would pick on clothes and bodies, with
// the scene's errors of click. Deterministic in (scene, seed); `dressed`: all that the dressed shots see.
Picks operate_on_clothes(const Scene& scene, const RayScene& dressed, const WornGarments& worn,
                         const SyntheticCapture& capture, Seed seed);

}  // namespace dressform
