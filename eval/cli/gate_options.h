#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "eval/cli/options.h"

namespace dressform {

// Options of all `dressform gate` commands.
struct GateOptions : CommonOptions {
  std::vector<std::string> cases;
  std::filesystem::path golden = "golden", work = "runs/gate";
  int jobs = 1;                            // check: cases run at a time
  std::filesystem::path junit;             // check
  std::string reason, scene;               // accept
  std::vector<std::string> items, misses;  // accept: "stage metric" or "image name"; "stage metric=why"
  std::vector<std::string> run_with;       // nuisance: commands that start a program
  double limit_minutes = 60;               // nuisance: of one program
  bool dry = false;                        // nuisance: nothing is written; power: the faults are only listed
  std::vector<std::string> faults, sizes;  // power
  int placements = 1;                      // power
};

// What each command does; gives the exit code.
int gate_check(const GateOptions& options);
int gate_run(const GateOptions& options);
int gate_accept(const GateOptions& options);
int gate_list(const GateOptions& options);
int gate_doctor(const GateOptions& options);
int gate_nuisance(const GateOptions& options);
int gate_power(const GateOptions& options);

// The named cases, or all of golden/.
std::vector<std::string> chosen_cases(const GateOptions& options);

}  // namespace dressform
