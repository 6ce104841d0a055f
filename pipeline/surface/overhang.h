#pragma once
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "scenes/mesh.h"

namespace dressform {

// Of each triangle of the body: whether it hangs over the trunk from further up, as a chin, a beard or long hair does,
// or can be reached from the trunk by way of such places alone. A garment goes round what is beneath, never round them.
// Below the armpits, and on arms and legs, nothing hangs. Model frame, y up.
std::vector<char> overhanging(const Mesh& body, const Landmarks& landmarks);

}  // namespace dressform
