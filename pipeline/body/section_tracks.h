#pragma once
#include <utility>
#include <vector>

#include "pipeline/body/body_limbs.h"

namespace dressform {

using LoopIndex = std::pair<int, int>;  // level, loop

// Loops of successive levels that lie over one another.
struct SectionTrack {
  std::vector<LoopIndex> loops;  // upwards
};

struct LegTracks {
  bool found = false;
  int crotch_level = 0;  // the first level where they are one
  int crotch_loop = 0;
  SectionTrack tracks[2];
};

// Two loops a little above the ankles, followed upwards until they are one.
LegTracks find_legs(const Sections& sections);

// The torso from the crotch to the top of the head; without legs from the floor.
SectionTrack find_torso(const Sections& sections, const LegTracks& legs);

// Whether two loops lie over one another, seen from above.
bool overlap(const SectionLoop& a, const SectionLoop& b);

// The parts of every loop, kept beside the sections; -1 = none of the known.
struct SectionTags {
  std::vector<std::vector<int>> part;

  explicit SectionTags(const Sections& sections) {
    for (const auto& level : sections.levels) part.emplace_back(level.size(), -1);
  }
};

// The limbs, and which part of the body every loop is.
struct TaggedLimbs {
  BodyLimbs limbs;
  SectionTags tags;
  SectionTrack torso;
};
TaggedLimbs tagged_limbs(const Mesh& body, const Sections& sections, const std::optional<Vector3d>& front_hint);

}  // namespace dressform
