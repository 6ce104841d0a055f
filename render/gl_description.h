#pragma once
#include <string>

namespace dressform {

// The renderer's implementation, which its images' bytes depend on: "4.5 (Compatibility Profile) Mesa 22.3.6, llvmpipe
// (LLVM 15.0.6, 256 bits)". The width of vectors is LP_NATIVE_VECTOR_WIDTH's where that is set. Throws
// std::runtime_error when no context can be made.
std::string gl_description();

}  // namespace dressform
