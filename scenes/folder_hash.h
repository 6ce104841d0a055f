#pragma once
#include <filesystem>
#include <string>

namespace dressform {

// Hash (hex) over the relative names and the bytes of all files below a folder; files and folders whose names begin
// with a dot are left out. That of nothing where there is no such folder. Throws InputError naming what can't be read.
std::string hash_folder(const std::filesystem::path& folder);

}  // namespace dressform
