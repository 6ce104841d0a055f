#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dressform {

// A run as the index lists it. `values` has a text for every column, empty where the run has no such row.
struct BrowsedRun {
  std::string folder;  // relative to the page
  std::string scene, variant, seed, scale, program;
  bool has_report = false;
  std::string thumbnail;  // JPEG bytes; may be empty
  std::vector<std::string> values, statuses;
};
struct BrowsedColumn {
  std::string stage, metric;
};

// One static page over many runs: to be sorted by any column and filtered by words; above each column its course over
// the runs in the order in which they were made. Without scripts it is the same table, in that order. Nothing is
// fetched; links lead to the runs' own reports.
std::string browse_html(const std::string& title, const std::vector<BrowsedColumn>& columns,
                        const std::vector<BrowsedRun>& runs);

// A polyline through the numbers that are there, scaled to its box, as SVG; empty for fewer than two.
std::string sparkline_svg(const std::vector<std::string>& values);

// Writes index.html into the folder from all runs below it, oldest first, with the measures that have a target. Returns
// how many runs it lists. Throws InputError where the folder holds none, or a run's files are damaged.
int write_browse_page(const std::filesystem::path& folder);

}  // namespace dressform
