#include "eval/studies/run_cells.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <set>

#include "eval/studies/masked_paths.h"
#include "eval/studies/shared_file.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/temporary_files.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// Nobody writes one cell for so long: its writer was killed, here or on another machine.
constexpr std::chrono::minutes kHalfWrittenFor{60};

std::string host_name() {
  char name[256] = "host";
  gethostname(name, sizeof name - 1);
  return name;
}

// "<id>.<host>.<process>": two processes never write into one folder.
fs::path work_folder(const fs::path& study, const std::string& id) {
  return study / "work" / fmt::format("{}.{}.{}", id, host_name(), getpid());
}

// What runs of this machine left behind that were killed.
void remove_dead_work(const fs::path& study) {
  for (const char* folder : {"cells", "costs"})
    if (fs::exists(study / folder)) remove_stale_temporaries(study / folder, kHalfWrittenFor);
  if (!fs::exists(study / "work")) return;
  for (const auto& entry : fs::directory_iterator(study / "work")) {
    const std::string name = entry.path().filename().string();
    const auto last = name.rfind('.');
    if (last == name.npos || name.find("." + host_name() + ".") == name.npos) continue;
    const int process = std::atoi(name.c_str() + last + 1);
    if (process > 0 && kill(process, 0) != 0 && errno == ESRCH) fs::remove_all(entry.path());
  }
}

// Held while a process works on the cells of one scene and seed; the kernel lets go of it when the process ends. Where
// the file system has no locks, several processes do the same work twice, with the same bytes.
class WorkLock {
 public:
  WorkLock(const fs::path& study, const std::string& name) {
    fs::create_directories(study / "locks");
    file_ = open((study / "locks" / name).c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  }
  ~WorkLock() {
    if (file_ >= 0) close(file_);
  }
  WorkLock(const WorkLock&) = delete;
  WorkLock& operator=(const WorkLock&) = delete;
  bool try_take() { return file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }
  void take() {
    if (file_ >= 0) flock(file_, LOCK_EX);
  }

 private:
  int file_ = -1;
};

// Cells that are worked on in one go by one process.
struct Group {
  std::string name;
  std::vector<PlannedCell> cells;
};

std::vector<PlannedCell> chosen_cells(const StudyPlan& plan, const RunCellsRequest& request) {
  std::set<std::string> wanted(request.only.begin(), request.only.end()), seen;
  std::vector<PlannedCell> cells;
  for (const auto& cell : cells_of(plan, request.folder))
    if ((request.only.empty() || wanted.count(cell.id)) && seen.insert(cell.id).second) cells.push_back(cell);
  for (const auto& id : wanted)
    if (!seen.count(id))
      throw InputError("--cell " + id, "is no cell of this study; expected one that `dressform study cells` lists");
  return cells;
}

std::vector<Group> grouped(const std::vector<PlannedCell>& cells, bool each_alone) {
  std::vector<Group> groups;
  for (const auto& cell : cells) {
    const std::string name = each_alone ? cell.id : fmt::format("scene{}_seed{}", cell.scene, cell.seed);
    if (groups.empty() || groups.back().name != name) groups.push_back({name, {}});
    groups.back().cells.push_back(cell);
  }
  return groups;
}

class CellRunner {
 public:
  CellRunner(const StudyPlan& plan, const RunCellsRequest& request, const MakeCell& make,
             const RunCellsProgress& progress)
      : plan_(plan), request_(request), make_(make), progress_(progress) {}

  RunCellsSummary run() {
    const auto cells = cells_ = chosen_cells(plan_, request_);
    total_ = static_cast<int>(cells.size());
    for (const auto& cell : cells) done_ += is_there(cell);
    summary_.present = done_;
    remove_dead_work(request_.folder);
    std::vector<Group> busy;
    for (const auto& group : grouped(cells, !request_.only.empty())) {
      WorkLock lock(request_.folder, group.name);
      if (lock.try_take())
        make_missing(group);
      else
        busy.push_back(group);
    }
    for (const auto& group : busy) {  // what the others did not finish
      WorkLock lock(request_.folder, group.name);
      lock.take();
      make_missing(group);
    }
    return summary_;
  }

 private:
  bool is_there(const PlannedCell& cell) const {
    const fs::path file = cell_file(request_.folder, cell.id);
    if (!can_be_opened(file)) return false;
    const CellResult found = read_cell(file);
    const std::string other = difference_of(found.signature, request_.signature);
    if (!other.empty() && !request_.renew)
      throw InputError(file.string(), "was made by another program (" + other +
                                          "); expected the same one, or --renew, or a new study folder");
    return other.empty() && !(found.failed && request_.retry_failed);
  }

  void make_missing(const Group& group) {
    for (const auto& cell : group.cells)
      if (!is_there(cell)) make_one(cell);
  }

  // Whose cell it is, whether it failed or not.
  MadeCell identified(MadeCell made, const PlannedCell& cell) const {
    made.result.id = cell.id;
    made.result.signature = request_.signature;
    made.result.scene = plan_.scenes[cell.scene].name;
    made.result.seed = cell.seed;
    made.result.scale = scale_of(plan_, cell);
    return made;
  }

  MadeCell attempt(const PlannedCell& cell, const fs::path& work) const {
    CellResult failed;
    failed.failed = true;
    try {
      return identified(make_(plan_, cell, work), cell);
    } catch (const InputError& error) {
      failed.reason = error.what();
    } catch (const std::exception& error) {
      failed.reason = std::string("crash: ") + error.what();
    }
    failed.reason = without_paths(failed.reason.substr(0, failed.reason.find('\n')), cell, work);
    return identified({failed, {}}, cell);
  }

  // A reason names no folder of this machine or process: the same failure gives the same bytes. Files that a scene
  // refers to lie beside it.
  std::string without_paths(const std::string& reason, const PlannedCell& cell, const fs::path& work) const {
    std::vector<std::pair<std::string, std::string>> words{{work.string(), "<run>"},
                                                           {request_.folder.string(), "<study>"}};
    const fs::path& scene = plan_.scenes[cell.scene].path;
    if (scene.is_absolute()) {
      words.push_back({scene.string(), "<scene>"});
      words.push_back({scene.parent_path().string(), "<scenes>"});
    }
    return with_masked_paths(reason, words);
  }

  void make_one(const PlannedCell& cell) {
    if (request_.workers > 1)  // others make cells too
      done_ = static_cast<int>(std::count_if(cells_.begin(), cells_.end(), [&](const PlannedCell& each) {
        return fs::exists(cell_file(request_.folder, each.id));
      }));
    if (progress_.begin) progress_.begin(cell, done_, total_, seconds_left());
    const auto start = std::chrono::steady_clock::now();
    const fs::path work = work_folder(request_.folder, cell.id);
    fs::create_directories(work);
    const MadeCell made = attempt(cell, work);
    write_file_atomically(cost_file(request_.folder, cell.id), cost_json(made.cost));
    (request_.durable ? write_file_durably : write_file_atomically)(cell_file(request_.folder, cell.id),
                                                                    cell_json(made.result));
    put_away(work, cell.id);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    spent_ += seconds;
    ++summary_.made, ++done_;
    summary_.failed += made.result.failed;
    if (progress_.end) progress_.end(cell, made, seconds);
  }

  // Kept folders have the cell's name alone: no process is looked for in it, so nobody takes them for a dead one's.
  void put_away(const fs::path& work, const std::string& id) const {
    const fs::path kept = request_.folder / "work" / id;
    if (!request_.keep_work) {
      fs::remove_all(work);
      return;
    }
    fs::remove_all(kept);
    fs::rename(work, kept);
  }

  double seconds_left() const {
    return summary_.made == 0 ? -1 : (total_ - done_) * spent_ / summary_.made / request_.workers;
  }

  const StudyPlan& plan_;
  const RunCellsRequest& request_;
  const MakeCell& make_;
  const RunCellsProgress& progress_;
  std::vector<PlannedCell> cells_;
  RunCellsSummary summary_;
  int done_ = 0, total_ = 0;
  double spent_ = 0;
};

}  // namespace

RunCellsSummary run_cells(const StudyPlan& plan, const RunCellsRequest& request, const MakeCell& make,
                          const RunCellsProgress& progress) {
  return CellRunner(plan, request, make, progress).run();
}

}  // namespace dressform
