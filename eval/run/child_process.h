#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dressform {

// A command of someone else's: one line for /bin/sh.
struct ChildCommand {
  std::string line;
  std::filesystem::path folder;       // where it runs
  double limit_seconds = 3600;        // then it is killed with all that it started
  std::filesystem::path output, log;  // files that take what it prints, and what it complains of (stderr)
};

struct ChildResult {
  int exit_code = 0;  // meaningful where neither of the two below says otherwise
  int signal = 0;     // that ended it; 0: it ended by itself
  bool timed_out = false;
  double limit_seconds = 0;
  std::string complaint;  // the end of its stderr, whole lines
  double seconds = 0, peak_memory_mb = 0;

  bool good() const { return exit_code == 0 && signal == 0 && !timed_out; }
  // "exit code 3", "signal 11 (Segmentation fault)", "no end after 60 s".
  std::string end_text() const;
};

// Runs a command to its end. It has no input, is a process group of its own, and is killed when this process dies.
// What it leaves running in the background is killed too. Throws InputError where it cannot be started.
ChildResult run_child(const ChildCommand& command);

// `text` as one word of a shell's command line, whatever it holds.
std::string shell_word(const std::string& text);

}  // namespace dressform
