#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace dressform {

// Names of the variants that the .cpp files of a folder register ("const Fuse::Variant variant{"tsdf", tsdf};"), in
// order. A file registers one variant, under its own name: what breaks that stands in the list as "file.cpp: name".
inline std::vector<std::string> variant_files(const std::filesystem::path& folder) {
  static const std::regex registration(R"re(::Variant\s+\w+\s*\{\s*"([^"]*)")re");
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const bool tests = stem.size() > 5 && stem.compare(stem.size() - 5, 5, "_test") == 0;
    if (entry.path().extension() != ".cpp" || tests) continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (std::sregex_iterator found(text.begin(), text.end(), registration), end; found != end; ++found) {
      const std::string name = (*found)[1];
      names.push_back(name == stem ? name : entry.path().filename().string() + ": " + name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace dressform
