#include "eval/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace dressform {

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(::isatty(2)) {}

void Progress::update(const std::string& what, int done, int total) {
  if (quiet_) return;
  const std::string part = total > 0 ? fmt::format(" {}/{}", done, total) : std::string();
  if (terminal_) {
    fmt::print(stderr, "\r\033[K  {}{} ...", what, part);
    std::fflush(stderr);
    return;
  }
  const int tenth = total > 0 ? done * 10 / total : -1;
  if (tenth == last_tenth_) return;
  last_tenth_ = tenth;
  if (total > 0) fmt::print(stderr, "{}{}\n", what, part);
}

void Progress::finish(const std::string& what, const std::string& note) {
  if (quiet_) return;
  fmt::print(stderr, "{}  {:<16} {}\n", terminal_ ? "\r\033[K" : "", what, note);
}

std::string seconds_text(double seconds) { return fmt::format("{:.1f} s", seconds); }

}  // namespace dressform
