#pragma once
#include "scenes/registry.h"

namespace dressform {

// A stage of the pipeline: a plain function from const inputs and a parameter struct to a new value. No I/O, no
// globals, no change of an input; seeds are passed in. See scenes/registry.h for how a variant registers itself.
template <class Tag, class Signature>
using Stage = Registry<Tag, Signature>;

}  // namespace dressform
