#include "eval/gate/environment.h"

#include <CGAL/version.h>
#include <embree3/rtcore_config.h>
#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <tbb/version.h>

#include <Eigen/Core>
#include <cstdlib>
#include <fstream>
#include <opencv2/core/utility.hpp>
#include <set>
#include <sstream>

#include "render/gl_description.h"

namespace dressform {
namespace {

// Variables that choose other code at run time: glibc's and Mesa's, OpenCV's dispatch.
constexpr const char* kVariables[] = {"GLIBC_TUNABLES", "LP_NATIVE_VECTOR_WIDTH", "OPENCV_CPU_DISABLE",
                                      "EIGEN_DONT_VECTORIZE", "GALLIUM_OVERRIDE_CPU_CAPS"};

std::string processor_flags() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("flags", 0) == 0 || line.rfind("Features", 0) == 0) return line.substr(line.find(':') + 1);
  return {};
}

}  // namespace

std::string instruction_sets(const std::string& flags) {
  static const std::set<std::string> chosen_by = {"sse4_1",   "sse4_2", "avx",     "avx2",     "fma",
                                                  "f16c",     "bmi2",   "avx512f", "avx512dq", "avx512bw",
                                                  "avx512vl", "asimd",  "sve"};
  std::set<std::string> found;
  std::istringstream words(flags);
  for (std::string word; words >> word;)
    if (chosen_by.count(word)) found.insert(word);
  std::string text;
  for (const auto& word : found) text += (text.empty() ? "" : " ") + word;
  return text;
}

Environment this_environment() {
  static const std::string renderer = gl_description();  // a context costs some tens of milliseconds
  Environment result{
      {"compiler", DRESSFORM_COMPILER},
      {"flags", DRESSFORM_FLAGS},
      {"glibc", gnu_get_libc_version()},
      {"opencv", cv::getVersionString()},
      {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"embree", RTC_VERSION_STRING},
      {"tbb", fmt::format("{}.{}", TBB_VERSION_MAJOR, TBB_VERSION_MINOR)},
      {"cgal", CGAL_VERSION_STR},
      {"renderer", renderer},
      {"instructions", instruction_sets(processor_flags())},
  };
  for (const char* variable : kVariables)
    if (const char* value = std::getenv(variable)) result[variable] = value;
  return result;
}

std::string environment_difference(const Environment& then, const Environment& now) {
  std::set<std::string> names;
  for (const auto* each : {&then, &now})
    for (const auto& [name, value] : *each) names.insert(name);
  const auto value_in = [](const Environment& where, const std::string& name) {
    const auto found = where.find(name);
    return found == where.end() ? std::string("none") : found->second;
  };
  std::string text;
  for (const auto& name : names)
    if (value_in(then, name) != value_in(now, name))
      text += fmt::format("{}{} {} -> {}", text.empty() ? "" : "; ", name, value_in(then, name), value_in(now, name));
  return text;
}

}  // namespace dressform
