#include "eval/studies/signature.h"

#include <CGAL/version.h>
#include <embree3/rtcore_config.h>
#include <fmt/format.h>
#include <open3d/Open3DConfig.h>

#include <Eigen/Core>
#include <opencv2/core/utility.hpp>
#include <set>

#include "eval/score/metric.h"
#include "pipeline/reconstruct.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

const char* const kCommit = "commit";
constexpr std::size_t kDigits = 12;  // of a hash: enough to tell two programs apart, short enough for a table

std::string code_hash() {
  std::string text =
      code_version("synthetic") + code_version("render") + code_version("eval/score") + code_version("eval/oracle");
  for (const auto& stage : describe_stages()) text += " " + code_version(stage.name);
  return hash_hex(text).substr(0, kDigits);
}

// 1050511000 is 5.5.1: two digits, two digits, one.
std::string cgal_version() {
  return fmt::format("{}.{}.{}", CGAL_VERSION_NR / 10000000 % 100, CGAL_VERSION_NR / 100000 % 100,
                     CGAL_VERSION_NR / 10000 % 10);
}

std::string metrics_hash() {
  std::string text;
  for (const Metric* metric : all_metrics())
    text += fmt::format("{} {}@{} {}\n", metric->stage, metric->name, metric->version, metric->unit);
  return hash_hex(text).substr(0, kDigits);
}

}  // namespace

Signature program_signature() {
  return {{"dressform", DRESSFORM_VERSION},
          {kCommit, code_version("commit")},
          {"code", code_hash()},
          {"metrics", metrics_hash()},
          {"compiler", DRESSFORM_COMPILER},
          {"opencv", cv::getVersionString()},
          {"open3d", OPEN3D_VERSION},
          {"cgal", cgal_version()},
          {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"embree", RTC_VERSION_STRING}};
}

Signature comparable(Signature signature) {
  signature.erase(kCommit);
  return signature;
}

std::string difference_of(const Signature& a, const Signature& b) {
  std::set<std::string> names;
  for (const auto* signature : {&a, &b})
    for (const auto& [name, value] : comparable(*signature)) names.insert(name);
  const auto value_in = [](const Signature& signature, const std::string& name) {
    const auto found = signature.find(name);
    return found == signature.end() ? std::string("none") : found->second;
  };
  std::string text;
  for (const auto& name : names)
    if (value_in(a, name) != value_in(b, name))
      text += fmt::format("{}{} {} and {}", text.empty() ? "" : ", ", name, value_in(a, name), value_in(b, name));
  return text;
}

}  // namespace dressform
