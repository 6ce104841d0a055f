#include "eval/cli/commands.h"

#include <map>

namespace dressform {
namespace {

using ByPlace = std::multimap<int, AddCommand>;

ByPlace& of_program() {
  static ByPlace commands;
  return commands;
}
ByPlace& of_study() {
  static ByPlace commands;
  return commands;
}

std::vector<AddCommand> in_order(const ByPlace& by_place) {
  std::vector<AddCommand> commands;
  for (const auto& [place, add] : by_place) commands.push_back(add);
  return commands;
}

}  // namespace

RegisteredCommand::RegisteredCommand(int place, AddCommand add) { of_program().emplace(place, add); }
std::vector<AddCommand> registered_commands() { return in_order(of_program()); }

RegisteredStudyCommand::RegisteredStudyCommand(int place, AddCommand add) { of_study().emplace(place, add); }
std::vector<AddCommand> registered_study_commands() { return in_order(of_study()); }

}  // namespace dressform
