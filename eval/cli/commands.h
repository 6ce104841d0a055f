#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

namespace dressform {

// A command adds itself to the program and returns what runs when it is chosen: a function that gives the exit code.
using Command = std::function<int()>;
using AddCommand = Command (*)(CLI::App&);

// A command is one .cpp file that registers itself:
//   const RegisteredCommand registered_run{10, add_run_command};
// `place` orders the commands in --help.
struct RegisteredCommand {
  RegisteredCommand(int place, AddCommand add);
};

// All commands in the order of --help.
std::vector<AddCommand> registered_commands();

// The same for a subcommand of `dressform study`, which is given that command to add itself to.
struct RegisteredStudyCommand {
  RegisteredStudyCommand(int place, AddCommand add);
};
std::vector<AddCommand> registered_study_commands();

}  // namespace dressform
