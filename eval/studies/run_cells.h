#pragma once
#include <functional>
#include <string>
#include <vector>

#include "eval/studies/cell.h"
#include "eval/studies/plan.h"

namespace dressform {

// Makes one cell; `work` is a folder of its own for what it writes on the way. Whatever it throws makes a failed cell.
// run_cells says whose cell it is (id, signature, scene, seed and scale of the result).
using MakeCell = std::function<MadeCell(const StudyPlan&, const PlannedCell&, const std::filesystem::path& work)>;

struct RunCellsRequest {
  std::filesystem::path folder;
  std::vector<std::string> only;  // ids; empty: all
  Signature signature;            // of this program
  bool retry_failed = false;      // failed cells once more
  bool renew = false;             // cells of other programs anew; false: they are an error
  int workers = 1;                // processes that work on the study now, this one counted: for the time that is left
  bool durable = false;           // each cell is on the disk before it has its name: power may fail, folders be shared
  bool keep_work = false;         // each cell's run stays in work/<cell id>
};

struct RunCellsProgress {
  // A cell begins: how many are done of how many, and the seconds left (negative: not known yet).
  std::function<void(const PlannedCell&, int done, int total, double seconds_left)> begin;
  std::function<void(const PlannedCell&, const MadeCell&, double seconds)> end;
};

struct RunCellsSummary {
  int made = 0, failed = 0, present = 0;  // made now (failed ones among them); there already
};

// Makes the cells that are not there yet, each written at once under its name when it is whole: a killed run goes on
// where it was, and several processes may work on one study (they take different scenes while there are any). Throws
// InputError for ids that the study does not have, and for cells of another program.
RunCellsSummary run_cells(const StudyPlan& plan, const RunCellsRequest& request, const MakeCell& make,
                          const RunCellsProgress& progress = {});

}  // namespace dressform
