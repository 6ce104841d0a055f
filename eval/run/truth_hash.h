#pragma once
#include <filesystem>
#include <string>

namespace dressform {

// Hash over the names and bytes of SESSION/truth; "none" when the session has no truth.
std::string truth_hash(const std::filesystem::path& session);

}  // namespace dressform
