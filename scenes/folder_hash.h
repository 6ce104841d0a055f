#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dressform {

// Hash (hex) over the relative names and the bytes of all files below a folder. Files and folders whose names begin
// with a dot are left out (writers that were killed leave them), and so is what lies in the folder itself under a name
// of `left_out`. That of nothing where there is no such folder. Throws InputError naming what can't be read.
std::string hash_folder(const std::filesystem::path& folder, const std::vector<std::string>& left_out = {});

}  // namespace dressform
