#include <memory>
#include <utility>

#include "eval/cli/commands.h"
#include "eval/cli/gate_options.h"
#include "eval/gate/golden_case.h"

namespace dressform {
namespace {

using GateAction = int (*)(const GateOptions&);

void add_check_options(CLI::App& command, GateOptions& options) {
  command.add_option("--jobs", options.jobs, "cases run at a time, the first one alone (default 1)")
      ->check(CLI::Range(1, 64));
  command.add_option("--junit", options.junit, "also write the verdicts here, as JUnit XML");
}

void add_accept_options(CLI::App& command, GateOptions& options) {
  command.add_option("--reason", options.reason, "why the change is right; kept in the case's history")->required();
  command
      .add_option("--item", options.items,
                  "only this: \"stage metric\" or \"image name\", as `gate check` prints it (repeatable)")
      ->allow_extra_args(false);
  command
      .add_option("--miss", options.misses,
                  "\"stage metric=why\": why a target is missed that no accept explained before (repeatable)")
      ->allow_extra_args(false);
  command.add_option("--scene", options.scene, "for a new case: its scene, relative to the folder of golden/");
  add_scene_options(command, options);
}

void add_nuisance_options(CLI::App& command, GateOptions& options) {
  command
      .add_option("--run-with", options.run_with,
                  "how to start the program in another environment, for /bin/sh: another build, or this one after "
                  "variables, e.g. \"LP_NATIVE_VECTOR_WIDTH=128 dressform\" (repeatable)")
      ->allow_extra_args(false)
      ->required();
  command.add_option("--limit-minutes", options.limit_minutes, "of one program; then it is stopped (default 60)")
      ->check(CLI::Range(0.1, 10000.0));
  command.add_flag("--dry", options.dry, "only say what was seen; write no nuisance.json");
}

void add_power_options(CLI::App& command, GateOptions& options) {
  command.add_option("--faults", options.faults, "steps (\"segment\") or faults (\"segment.shifted\"); default all");
  command.add_option("--sizes", options.sizes, "small, medium, large; default all");
  command.add_option("--placements", options.placements, "how many places of each fault and size (default 1)")
      ->check(CLI::Range(1, 1000));
  command.add_flag("--list", options.dry, "only list the faults with their sizes");
}

Command add_gate_command(CLI::App& app) {
  auto options = std::make_shared<GateOptions>();
  auto* command = app.add_subcommand("gate", "Compare runs with the accepted references in golden/");
  command->require_subcommand(1);
  auto actions = std::make_shared<std::vector<std::pair<CLI::App*, GateAction>>>();
  const auto add = [&](const char* name, const char* what, GateAction action) {
    auto* sub = command->add_subcommand(name, what);
    sub->add_option("--golden", options->golden, "folder of the references (default golden)");
    actions->push_back({sub, action});
    return sub;
  };
  const auto add_runner = [&](const char* name, const char* what, GateAction action) {
    auto* sub = add(name, what, action);
    sub->add_option("--work", options->work, "folder for the runs (default runs/gate)");
    add_threads(*sub, *options);
    return sub;
  };
  auto* check = add_runner("check", "Run the cases and compare; never writes to golden/", gate_check);
  add_check_options(*check, *options);
  auto* run = add_runner("run", "Run the cases and keep what they show, without comparing", gate_run);
  auto* accept = add_runner("accept", "Make what is new or beyond tolerance in the run that was checked the reference",
                            gate_accept);
  accept->add_option("cases", options->cases, "cases")->required();
  add_accept_options(*accept, *options);
  auto* nuisance = add_runner("nuisance", "Measure how far other environments move the numbers; golden/nuisance.json",
                              gate_nuisance);
  add_nuisance_options(*nuisance, *options);
  auto* power = add_runner(
      "power", "Put faults of known sizes into the cases: which does the gate find, whom does it blame", gate_power);
  add_power_options(*power, *options);
  auto* list = add("list", "The references: what is kept, since when, and why", gate_list);
  for (auto* each : {check, run, nuisance, list}) each->add_option("cases", options->cases, "cases; default all");
  power->add_option("--cases", options->cases, "cases; default all");
  add("doctor", "What is wrong with the references themselves, without running anything", gate_doctor);
  command->footer(
      "Examples:\n  dressform gate check group1 --junit gate.xml\n"
      "  dressform gate accept group1 --reason \"new default for surface: rims 2 mm better\"\n"
      "  dressform gate accept group1 --item \"surface top/f_5mm@1\" --reason \"coarser on purpose\"\n"
      "  dressform gate accept group1 --reason \"new scene\" --miss \"open bottom/rims_hd95_mm@1=no view sees the "
      "waist\"\n"
      "  dressform gate nuisance --run-with \"LP_NATIVE_VECTOR_WIDTH=128 dressform\" --run-with build-clang/dressform\n"
      "  dressform gate power --cases group4 --faults segment registration.view_moved --sizes medium large\n"
      "Exit codes: 0 pass (identical, within nuisance, better), 1 regression, 2 usage or bad input, 3 missing, "
      "corrupt\n"
      "or obsolete reference, 4 a run crashed.");
  return [options, actions] {
    for (const auto& [sub, action] : *actions)
      if (sub->parsed()) return action(*options);
    return static_cast<int>(kBadInput);
  };
}

const RegisteredCommand registered_gate{110, add_gate_command};

}  // namespace

std::vector<std::string> chosen_cases(const GateOptions& options) {
  return options.cases.empty() ? golden_case_names(options.golden) : options.cases;
}

}  // namespace dressform
