#include "eval/studies/results_index.h"

#include <sqlite3.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "eval/run/run_facts.h"
#include "eval/score/metric.h"
#include "eval/score/scores.h"
#include "eval/studies/cell.h"
#include "eval/studies/plan.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct RunRow {
  std::string kind, folder, scene, variant;
  Seed seed = 0;
  std::optional<double> scale;
  std::string program;
  std::int64_t modified = 0;
};

std::int64_t modified_seconds(const fs::path& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0 ? static_cast<std::int64_t>(status.st_mtime) : 0;
}

std::string signature_text(const Signature& signature) {
  std::string text;
  for (const char* name : {"commit", "code", "metrics"})
    if (const auto found = signature.find(name); found != signature.end())
      text += (text.empty() ? "" : ", ") + std::string(name) + " " + found->second;
  return text;
}

}  // namespace

struct ResultsIndex::Database {
  sqlite3* handle = nullptr;
  ~Database() { sqlite3_close(handle); }

  [[noreturn]] void fail(const std::string& where) const {
    throw InputError(where, std::string(sqlite3_errmsg(handle)) +
                                "; expected one SELECT over runs(run, kind, folder, scene, variant, seed, scale, "
                                "program, modified) and scores(run, stage, metric, unit, value, status, n_samples)");
  }
  void execute(const char* sql) const {
    if (sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail("index");
  }
};

namespace {

// A prepared statement with its arguments by place.
class Statement {
 public:
  Statement(sqlite3* handle, const char* sql) {
    if (sqlite3_prepare_v2(handle, sql, -1, &statement_, &rest_) != SQLITE_OK) statement_ = nullptr;
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  bool good() const { return statement_ != nullptr; }
  // Whether it can only read, and nothing follows it.
  bool only_reads() const {
    return sqlite3_stmt_readonly(statement_) && std::string(rest_).find_first_not_of(" \t\n;") == std::string::npos;
  }
  void bind(int place, const std::string& text) {
    sqlite3_bind_text(statement_, place, text.c_str(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  void bind(int place, double value) {
    if (std::isfinite(value)) sqlite3_bind_double(statement_, place, value);
  }
  void bind(int place, std::int64_t value) { sqlite3_bind_int64(statement_, place, value); }
  bool step() { return sqlite3_step(statement_) == SQLITE_ROW; }
  void insert() {
    sqlite3_step(statement_);
    sqlite3_reset(statement_);
    sqlite3_clear_bindings(statement_);
  }
  int columns() const { return sqlite3_column_count(statement_); }
  std::string column_name(int column) const { return sqlite3_column_name(statement_, column); }
  std::string text(int column) const {
    const auto* bytes = sqlite3_column_text(statement_, column);
    return bytes ? reinterpret_cast<const char*>(bytes) : "";
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
  const char* rest_ = nullptr;
};

class Filler {
 public:
  explicit Filler(sqlite3* handle)
      : runs_(handle, "INSERT INTO runs VALUES (?,?,?,?,?,?,?,?,?)"),
        scores_(handle, "INSERT INTO scores VALUES (?,?,?,?,?,?,?)") {}

  void add(const RunRow& row, const std::vector<ScoreRow>& scores) {
    const std::int64_t run = ++count_;
    runs_.bind(1, run);
    runs_.bind(2, row.kind);
    runs_.bind(3, row.folder);
    runs_.bind(4, row.scene);
    runs_.bind(5, row.variant);
    runs_.bind(6, static_cast<std::int64_t>(row.seed));
    if (row.scale) runs_.bind(7, *row.scale);
    runs_.bind(8, row.program);
    runs_.bind(9, row.modified);
    runs_.insert();
    for (const auto& score : scores) add_score(run, score);
  }

  void add_run(const fs::path& scores_file) {
    const Scores scores = scores_from_json(scores_file);
    const fs::path run = scores_file.parent_path();
    const RunFacts facts = read_run_facts(run);  // the scores stand alone where it has none
    add({"run", run.string(), scores.scene, scores.variant, scores.seed, facts.scale, facts.commit,
         modified_seconds(scores_file)},
        scores.rows);
  }

  void add_study(const fs::path& folder) {
    const StudyPlan plan = read_plan(folder);
    for (const auto& each : cells_of(plan, folder)) {
      const fs::path file = cell_file(folder, each.id);
      if (!fs::exists(file)) continue;
      const CellResult cell = read_cell(file);
      add({"cell", folder.string(), cell.scene, plan.study.variants[each.variant].name, cell.seed, cell.scale,
           signature_text(cell.signature), modified_seconds(file)},
          cell.scores);
    }
  }

  int count() const { return static_cast<int>(count_); }

 private:
  void add_score(std::int64_t run, const ScoreRow& score) {
    scores_.bind(1, run);
    scores_.bind(2, score.stage);
    scores_.bind(3, score.metric);
    scores_.bind(4, score.unit);
    scores_.bind(5, score.value);
    scores_.bind(6, score.status);
    scores_.bind(7, static_cast<std::int64_t>(score.n_samples));
    scores_.insert();
  }
  Statement runs_, scores_;
  std::int64_t count_ = 0;
};

// Files and studies below a folder, in the order of their names. Hidden folders (stores) are passed over.
void fill_from(const fs::path& folder, Filler& filler) {
  if (!fs::is_directory(folder)) throw InputError(folder.string(), "is no folder; expected one with runs or studies");
  if (fs::exists(folder / "study.json")) {
    filler.add_study(folder);
    return;
  }
  if (fs::exists(folder / "scores.json")) {
    filler.add_run(folder / "scores.json");
    return;
  }
  std::vector<fs::path> below;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && entry.path().filename().string()[0] != '.') below.push_back(entry.path());
  std::sort(below.begin(), below.end());
  for (const auto& each : below) fill_from(each, filler);
}

}  // namespace

ResultsIndex::ResultsIndex(const std::vector<fs::path>& folders) : database_(std::make_unique<Database>()) {
  if (sqlite3_open(":memory:", &database_->handle) != SQLITE_OK) database_->fail("index");
  database_->execute(
      "CREATE TABLE runs(run INTEGER PRIMARY KEY, kind TEXT, folder TEXT, scene TEXT, variant TEXT, seed INTEGER, "
      "scale REAL, program TEXT, modified INTEGER);"
      "CREATE TABLE scores(run INTEGER, stage TEXT, metric TEXT, unit TEXT, value REAL, status TEXT, "
      "n_samples INTEGER); BEGIN");
  Filler filler(database_->handle);
  for (const auto& folder : folders) fill_from(folder, filler);
  database_->execute("COMMIT; CREATE INDEX by_metric ON scores(stage, metric)");
  runs_ = filler.count();
}

ResultsIndex::~ResultsIndex() = default;

ResultsIndex::Rows ResultsIndex::query(const std::string& sql, const std::vector<std::string>& arguments) const {
  Statement statement(database_->handle, sql.c_str());
  if (!statement.good()) database_->fail("--sql");
  if (!statement.only_reads()) throw InputError("--sql", "found more than a question; expected one SELECT");
  for (std::size_t i = 0; i < arguments.size(); ++i) statement.bind(static_cast<int>(i) + 1, arguments[i]);
  Rows rows;
  for (int column = 0; column < statement.columns(); ++column) rows.columns.push_back(statement.column_name(column));
  while (statement.step()) {
    rows.values.emplace_back();
    for (int column = 0; column < statement.columns(); ++column) rows.values.back().push_back(statement.text(column));
  }
  return rows;
}

std::vector<Change> changes_of(const std::vector<HistoryPoint>& points, const std::string& stage,
                               const std::string& metric) {
  const Metric* declared = find_metric(stage, metric);
  if (!declared)
    throw InputError("--history " + stage + " " + metric, "is not declared; expected a row of dressform metrics");
  const Nuisance nuisance = declared->nuisance();
  std::vector<Change> changes;
  double stood = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double value = points[i].value;
    const bool step = i > 0 && std::abs(value - points[i - 1].value) > nuisance.tolerance(points[i - 1].value);
    const bool creep = i > 0 && !step && std::abs(value - stood) > nuisance.tolerance(stood);
    changes.push_back(step ? Change::step : creep ? Change::creep : Change::none);
    if (i == 0 || step) stood = value;
  }
  return changes;
}

}  // namespace dressform
