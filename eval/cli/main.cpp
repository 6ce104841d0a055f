#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "scenes/error.h"

namespace {

using namespace dressform;

constexpr const char* kFooter =
    "Example:\n"
    "  dressform run scenes/library/group1.toml -o runs/group1\n"
    "Exit codes: 0 success, 1 regression found by the gate, 2 usage or bad input, 3 missing, corrupt or obsolete "
    "golden,\n"
    "4 crash inside a run, 5 the run ended but garments are missing from its out/ (the stage that lost them is named).";

int run_program(int argc, char** argv) {
  CLI::App app{"dressform: four Kinect views of a dressed mannequin in, textured clothes resized to a customer out."};
  app.set_version_flag("--version", "dressform " DRESSFORM_VERSION);
  app.footer(kFooter);
  app.require_subcommand(1);
  std::vector<std::pair<CLI::App*, Command>> commands;
  for (const AddCommand add : registered_commands()) {
    Command command = add(app);
    commands.push_back({app.get_subcommands({}).back(), std::move(command)});
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kBadInput;
  }
  for (const auto& [subcommand, command] : commands)
    if (subcommand->parsed()) return command();
  return kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return kBadInput;
  } catch (const std::filesystem::filesystem_error& error) {  // a full disk, a folder that is read-only
    fmt::print(stderr, "error: {}: {}; expected a place that can be read and written and has room\n",
               (error.path2().empty() ? error.path1() : error.path2()).string(), error.code().message());
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "crash: {}\n", error.what());
    return kCrash;
  }
}
