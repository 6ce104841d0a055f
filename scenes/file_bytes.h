#pragma once
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>

namespace dressform {

// The whole file. Throws InputError naming it when it is missing, no regular file, cannot be read, or has more than
// `most_bytes`: then it is not read at all.
std::string read_file_bytes(const std::filesystem::path& path,
                            std::size_t most_bytes = std::numeric_limits<std::size_t>::max());

// Writes to a temporary name in the same folder, then renames: `path` holds the old bytes or the new ones, never half.
// Throws InputError naming the file when it cannot be written.
void write_file_atomically(const std::filesystem::path& path, const std::string& bytes);

// Takes away what writers that were killed left half-written in a folder; files of running processes stay.
void remove_stale_temporaries(const std::filesystem::path& folder);

}  // namespace dressform
