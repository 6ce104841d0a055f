#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace dressform {

// XXH3 128-bit hash as 32 hex digits: content keys and damage detection, no cryptography.
std::string hash_hex(std::string_view bytes);

// The same of a file's bytes, read in blocks. Throws InputError naming the file when it can't be read.
std::string hash_file(const std::filesystem::path& file);

}  // namespace dressform
