#pragma once
#include <filesystem>
#include <vector>

namespace dressform {

struct MergeSummary {
  int taken = 0, known = 0;  // cells copied; cells that were there already
};

// Takes the cells that other folders of the same study made (on other machines) into `folder`. Throws InputError before
// anything is written when a folder holds another study, a cell is damaged, signatures differ, or a cell has other
// bytes than the one that is there: then one of the two is not reproducible.
MergeSummary merge_studies(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& others);

}  // namespace dressform
