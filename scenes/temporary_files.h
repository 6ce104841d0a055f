#pragma once
#include <chrono>
#include <filesystem>
#include <string>

namespace dressform {

// A name beside `path` that no other writer has: <path>.tmp<process>-<serial>.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

// Whether `name` is one that temporary_beside gives.
bool is_temporary_name(const std::string& name);

// Takes away what writers that were killed left half-written in a folder, files and folders whose names begin with
// `prefix`; those of running processes stay, and those changed less than `least_age` ago: where containers share a
// folder, a process that runs may be another's.
void remove_stale_temporaries(const std::filesystem::path& folder, std::chrono::seconds least_age,
                              const std::string& prefix = {});

}  // namespace dressform
