#pragma once
#include "pipeline/body/standing_body.h"

namespace dressform {

// The heading at which a body's outlines agree best with those of another one.
struct Likeness {
  double turn_rad = 0;  // from the front that the body has by itself, towards its left
  bool sure = false;    // false: the two best turns are nearly as good as one another
};

// Whatever the headings of the two: the turn at which the outlines agree best over all heights (feet point forward, the
// seat backward), then refined on the trunk alone.
Likeness likeness(const StandingBody& known, const StandingBody& body);

}  // namespace dressform
