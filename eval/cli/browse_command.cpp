#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/report/browse_page.h"

namespace dressform {
namespace {

Command add_browse_command(CLI::App& app) {
  auto folder = std::make_shared<std::filesystem::path>();
  auto* command = app.add_subcommand("browse", "One static page over all runs below a folder: sort, filter, courses");
  command->add_option("folder", *folder, "folder with runs below it; index.html is written into it")->required();
  command->footer("Example:\n  dressform browse runs");
  return [folder]() -> int {
    const int runs = write_browse_page(*folder);
    fmt::print("{}: {} runs\n", (*folder / "index.html").string(), runs);
    return kSuccess;
  };
}

const RegisteredCommand registered_browse{98, add_browse_command};

}  // namespace
}  // namespace dressform
