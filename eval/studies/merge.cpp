#include "eval/studies/merge.h"

#include <map>
#include <optional>

#include "eval/studies/cell.h"
#include "eval/studies/plan.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

void check_same_study(const fs::path& folder, const fs::path& other) {
  read_plan(other);
  if (read_file_bytes(folder / "study.json") != read_file_bytes(other / "study.json"))
    throw InputError(other.string(), "holds another study than " + folder.string() + "; expected the same study.json");
}

// A cell's bytes, but for what does not count.
std::string what_counts(CellResult cell) {
  cell.signature = comparable(std::move(cell.signature));
  return cell_json(cell);
}

struct Incoming {
  fs::path from;
  std::string bytes;
};

}  // namespace

MergeSummary merge_studies(const fs::path& folder, const std::vector<fs::path>& others) {
  const StudyPlan plan = read_plan(folder);
  for (const auto& other : others) check_same_study(folder, other);
  std::map<std::string, Incoming> incoming;
  std::optional<CellResult> first;  // whose signature all have
  MergeSummary summary;
  const auto checked = [&](const fs::path& file) {
    CellResult cell = read_cell(file);
    if (!first) first = cell;
    const std::string other = difference_of(first->signature, cell.signature);
    if (!other.empty())
      throw InputError(file.string(), "has another signature (" + other + "); expected cells of one program");
    return what_counts(std::move(cell));
  };
  for (const auto& cell : cells_of(plan, folder)) {
    const fs::path own = cell_file(folder, cell.id);
    std::string known = fs::exists(own) ? checked(own) : std::string();
    for (const auto& other : others) {
      const fs::path file = cell_file(other, cell.id);
      if (!fs::exists(file)) continue;
      const std::string found = checked(file);
      if (known.empty()) {
        incoming[cell.id] = {other, read_file_bytes(file)};
        known = found;
      } else if (known != found) {
        throw InputError(file.string(), "differs from the same cell made elsewhere; expected the same bytes");
      } else {
        ++summary.known;
      }
    }
  }
  for (const auto& [id, cell] : incoming) {
    const fs::path cost = cost_file(cell.from, id);
    if (fs::exists(cost)) write_file_atomically(cost_file(folder, id), read_file_bytes(cost));
    write_file_atomically(cell_file(folder, id), cell.bytes);
    ++summary.taken;
  }
  return summary;
}

}  // namespace dressform
