#pragma once
#include <map>
#include <string>

namespace dressform {

// What the bytes of results may depend on beside the project's own code and the inputs: compiler, flags, versions of
// the libraries, the processor's instruction sets that libraries choose by, the renderer, and the environment variables
// that mask or choose them. By name. The number of threads is not among them: the same bytes are promised for any.
using Environment = std::map<std::string, std::string>;
Environment this_environment();

// What differs, for people: "compiler GNU 12.2.0 -> Clang 14.0.6; flags -O2 -> -O3". Empty where nothing does.
std::string environment_difference(const Environment& then, const Environment& now);

// The instruction sets among the words of a processor's flags that change which code libraries run, sorted; of `flags`
// as in /proc/cpuinfo, "fpu sse avx2 ...".
std::string instruction_sets(const std::string& flags);

}  // namespace dressform
