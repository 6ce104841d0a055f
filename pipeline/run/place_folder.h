#pragma once
#include <filesystem>
#include <functional>

namespace dressform {

// Makes a folder of a store whole or not at all: `fill` writes into a temporary one beside it, which then takes its
// place. What another process put there meanwhile stays if it is `intact` (it is the same), so that nobody's reading is
// disturbed; a damaged one goes. Throws what `fill` throws, and std::filesystem::filesystem_error.
void place_folder(const std::filesystem::path& target, const std::function<void(const std::filesystem::path&)>& fill,
                  const std::function<bool()>& intact);

}  // namespace dressform
