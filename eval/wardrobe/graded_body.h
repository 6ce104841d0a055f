#pragma once
#include "eval/wardrobe/size_chart.h"
#include "pipeline/body/body_landmarks.h"

namespace dressform {

// Tape girths of a body, metres.
struct BodyGirths {
  double chest_m = 0, waist_m = 0, hip_m = 0;
};
// Throws InputError naming `whose` where the body has no trunk that a tape goes round.
BodyGirths girths_of(const Mesh& body, const std::string& whose);

// The body graded to other girths, as a tailor grades a pattern: every level scaled across the trunk's axis so that the
// tape has the wanted girths at chest, waist and hip, in between linear; from the chest up and from the hip down as
// there, arms as the chest. Heights stay. Same triangles, landmarks of the new mesh. Throws InputError naming `whose`
// as girths_of.
KnownBody graded_body(const KnownBody& body, const BodyGirths& wanted, const std::string& whose);

}  // namespace dressform
