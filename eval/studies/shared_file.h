#pragma once
#include <filesystem>
#include <string>

namespace dressform {

// Files in a folder that several machines share, over NFS or the like.

// As write_file_atomically, with the bytes on the disk before the file has its name, and the name before it returns:
// when power fails there is the whole file or none.
void write_file_durably(const std::filesystem::path& path, const std::string& bytes);

// Whether a file is there, told by opening it: file systems answer from memory, and late, what a name stands for, but
// ask the server when a file is opened.
bool can_be_opened(const std::filesystem::path& file);

}  // namespace dressform
