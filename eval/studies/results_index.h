#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dressform {

// All numbers below some folders as an SQLite database, made anew from the files every time: scores.json of runs (with
// what their run.json says) and the cells of studies. In memory, so that no shared file system is asked to lock it.
//   runs(run, kind, folder, scene, variant, seed, scale, program, modified)   kind: run, cell; modified: s since 1970
//   scores(run, stage, metric, unit, value, status, n_samples)
// program: the commit of a run; "code ..., metrics ..." of a cell.
class ResultsIndex {
 public:
  // Throws InputError for folders that are not there, and for damaged files.
  explicit ResultsIndex(const std::vector<std::filesystem::path>& folders);
  ~ResultsIndex();

  struct Rows {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> values;  // "" for NULL
  };
  // One SELECT. Throws InputError with SQLite's words where it is wrong, or writes.
  Rows query(const std::string& sql, const std::vector<std::string>& arguments = {}) const;

  int runs() const { return runs_; }

 private:
  struct Database;
  std::unique_ptr<Database> database_;
  int runs_ = 0;
};

// One number over time: what the runs of one scene, variant, seed and scale gave, in the order in which they were made.
struct HistoryPoint {
  std::string folder, program;
  double value = 0;
};
enum class Change { none, step, creep };
// A step is more than the metric's nuisance from the run before. Creep: no step, but more than that from the last value
// that stood after a step (or the first one).
std::vector<Change> changes_of(const std::vector<HistoryPoint>& points, const std::string& stage,
                               const std::string& metric);

}  // namespace dressform
