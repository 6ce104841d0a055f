#include "eval/cli/commands.h"

#include <map>

namespace dressform {
namespace {

std::multimap<int, AddCommand>& by_place() {
  static std::multimap<int, AddCommand> commands;
  return commands;
}

}  // namespace

RegisteredCommand::RegisteredCommand(int place, AddCommand add) { by_place().emplace(place, add); }

std::vector<AddCommand> registered_commands() {
  std::vector<AddCommand> commands;
  for (const auto& [place, add] : by_place()) commands.push_back(add);
  return commands;
}

}  // namespace dressform
