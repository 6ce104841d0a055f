#include "pipeline/body/section_tracks.h"

#include <algorithm>
#include <array>

namespace dressform {
namespace {

// Where the two legs are looked for, of the stature, in turn: above feet, shoes and ankles, which may touch, and below
// the knees; the lowest last, for a body whose calves are one piece.
constexpr std::array kAboveAnkles{0.14, 0.20, 0.26, 0.10};
constexpr int kHighestFork_tenths = 7;  // of the stature: thighs that are not one piece below it are no legs

// The largest loop of `level` that overlaps `loop`, or -1.
int follow(const Sections& sections, const SectionLoop& loop, int level) {
  if (level < 0 || level >= static_cast<int>(sections.levels.size())) return -1;
  for (std::size_t i = 0; i < sections.levels[level].size(); ++i)
    if (overlap(sections.levels[level][i], loop)) return static_cast<int>(i);
  return -1;
}

SectionTrack track_down(const Sections& sections, LoopIndex at) {
  SectionTrack track{{at}};
  while (true) {
    const int next = follow(sections, sections.levels[at.first][at.second], at.first - 1);
    if (next < 0) break;
    at = {at.first - 1, next};
    track.loops.push_back(at);
  }
  std::reverse(track.loops.begin(), track.loops.end());
  return track;
}

}  // namespace

bool overlap(const SectionLoop& a, const SectionLoop& b) {
  if (contains(a, b.centroid) || contains(b, a.centroid)) return true;
  for (std::size_t i = 0; i < a.points.size(); i += 4)
    if (contains(b, a.points[i])) return true;
  return false;
}

// Two loops a little above the ankles, followed upwards until they are one.
LegTracks find_legs(const Sections& sections) {
  LegTracks legs;
  const int count = static_cast<int>(sections.levels.size());
  for (const double part : kAboveAnkles) {
    const int start = static_cast<int>(part * count);
    if (start >= count || sections.levels[start].size() < 2) continue;
    LoopIndex at[2] = {{start, 0}, {start, 1}};
    for (int k = 0; k < 2; ++k) legs.tracks[k] = track_down(sections, at[k]);
    for (int level = start + 1; level < count * kHighestFork_tenths / 10; ++level) {
      int next[2];
      for (int k = 0; k < 2; ++k) next[k] = follow(sections, sections.levels[at[k].first][at[k].second], level);
      if (next[0] < 0 || next[1] < 0) break;
      if (next[0] == next[1]) {
        legs.found = true;
        legs.crotch_level = level;
        legs.crotch_loop = next[0];
        return legs;
      }
      for (int k = 0; k < 2; ++k) {
        at[k] = {level, next[k]};
        legs.tracks[k].loops.push_back(at[k]);
      }
    }
  }
  return legs;
}

// The torso from the crotch to the top of the head; without legs from the floor.
SectionTrack find_torso(const Sections& sections, const LegTracks& legs) {
  SectionTrack track;
  const int count = static_cast<int>(sections.levels.size());
  LoopIndex at = legs.found ? LoopIndex{legs.crotch_level, legs.crotch_loop} : LoopIndex{count / 2, 0};
  while (at.first < count && sections.levels[at.first].empty()) ++at.first;
  if (at.first >= count) return track;
  track = legs.found ? SectionTrack{{at}} : track_down(sections, at);
  while (true) {
    const int next = follow(sections, sections.levels[at.first][at.second], at.first + 1);
    if (next < 0) break;
    at = {at.first + 1, next};
    track.loops.push_back(at);
  }
  return track;
}

}  // namespace dressform
